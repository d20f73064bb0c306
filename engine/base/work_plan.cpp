#include "engine/base/work_plan.h"

#include <algorithm>
#include <cmath>

namespace splatray {

void WorkTrack::begin(const std::string& stage) {
  stage_ = stage;
  pass_ = 0;
  reported_ = share_ = 0.0;
  const auto is_it = [&stage](const PlannedStage& planned) { return planned.name == stage; };
  const auto from = plan_.begin() + static_cast<std::ptrdiff_t>(current_);
  auto found = std::find_if(from, plan_.end(), is_it);
  if (found == plan_.end()) found = std::find_if(plan_.begin(), plan_.end(), is_it);  // of another input
  is_planned_ = found != plan_.end();
  if (is_planned_) current_ = static_cast<std::size_t>(found - plan_.begin());
}

void WorkTrack::reached(const std::string& stage, double share) {
  if (stage != stage_) begin(stage);
  if (share < reported_) ++pass_;
  reported_ = share;
  const unsigned passes = is_planned_ ? std::max(plan_[current_].passes, pass_ + 1) : pass_ + 1;
  share_ = std::max(share_, (pass_ + share) / passes);
  if (!is_planned_) return;
  double before = 0.0, all = 0.0;
  for (std::size_t i = 0; i < plan_.size(); ++i) {
    all += plan_[i].cost;
    if (i < current_) before += plan_[i].cost;
  }
  if (all > 0.0) total_ = std::max(total_, std::min((before + plan_[current_].cost * share_) / all, 1.0));
}

std::string time_left(double elapsed_s, double share) {
  constexpr double LEAST_S = 3.0, LEAST_SHARE = 0.02, MINUTE = 60.0, HOUR = 60.0;
  if (elapsed_s < LEAST_S || share < LEAST_SHARE || share >= 1.0) return {};
  const double left_s = elapsed_s * (1.0 - share) / share;
  if (left_s < 2.0 * MINUTE) return std::to_string(std::lround(std::ceil(left_s))) + " s";
  const long minutes = std::lround(left_s / MINUTE);
  const long hours = minutes / static_cast<long>(HOUR);
  if (hours == 0) return std::to_string(minutes) + " min";
  return std::to_string(hours) + " h " + std::to_string(minutes % static_cast<long>(HOUR)) + " min";
}

}  // namespace splatray
