#include "app/view/view_stats.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/base/json_text.h"
#include "engine/file/atomic_file.h"

namespace splatray {
namespace {

constexpr std::chrono::milliseconds STANDSTILL{500};  ///< a longer gap is no motion

double milliseconds(ViewStats::Clock::duration time) {
  return std::chrono::duration<double, std::milli>(time).count();
}

}  // namespace

void ViewStats::shown(const SharedFrame& frame, Clock::time_point now) {
  std::optional<double>& first_ms = frame->of_points ? first_points_ms_ : first_ms_;
  if (!first_ms) first_ms = milliseconds(now - start_);
  ++(frame->of_points ? point_pictures_ : pictures_);
  if (frame->moving && frame_ && frame_->moving && now - last_ < STANDSTILL) {
    ++moving_pictures_;
    moving_ms_ += milliseconds(now - last_);
    scale_sum_ += frame->scale;
  }
  last_ = now;
  frame_ = frame;
  has_news_ |= !frame->moving || pictures_ == 1;
  std::erase_if(recent_, [now](Clock::time_point time) { return now - time > std::chrono::seconds(1); });
  recent_.push_back(now);
}

void ViewStats::add_error(const std::string& error) {
  if (!errors_.empty() && errors_.back() == error) return;
  errors_.push_back(error);
  has_news_ = true;
}

double ViewStats::per_second(Clock::time_point now) const {
  return static_cast<double>(std::count_if(recent_.begin(), recent_.end(), [now](Clock::time_point time) {
    return now - time <= std::chrono::seconds(1);
  }));
}

void ViewStats::write(const std::filesystem::path& path, std::uint32_t validation_messages) {
  has_news_ = false;
  const double moving = static_cast<double>(moving_pictures_);
  nlohmann::ordered_json json;
  json["device"] = frame_ ? frame_->device : "";
  json["first_picture_ms"] = first_ms_.value_or(0.0);
  json["first_points_ms"] = first_points_ms_.value_or(0.0);
  json["pictures"] = pictures_;
  json["pictures_of_points"] = point_pictures_;
  json["moving"] = {{"pictures", moving_pictures_},
                    {"per_second", moving_ms_ > 0.0 ? 1000.0 * moving / moving_ms_ : 0.0},
                    {"mean_scale", moving_pictures_ > 0 ? scale_sum_ / moving : 0.0}};
  json["size"] = {frame_ ? frame_->view.width : 0, frame_ ? frame_->view.height : 0};
  json["samples"] = frame_ ? frame_->samples : 0;
  json["pools_uploaded"] = frame_ ? frame_->pools_uploaded : 0;
  json["errors"] = errors_;
  json["validation_messages"] = validation_messages;
  write_text_file(json_text(json, 2) + "\n", path);
}

}  // namespace splatray
