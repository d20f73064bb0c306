/// Work of several stages that are known before: how far it is in all, and how long it will still take.
#pragma once
#include <string>
#include <utility>
#include <vector>

namespace splatray {

/// A stage of work.
struct PlannedStage {
  std::string name;
  double cost;  ///< its part of what the work typically takes, in any unit that the plan's stages share
  unsigned passes = 1;  ///< how often it typically counts from 0 to 1
};
using WorkPlan = std::vector<PlannedStage>;

/// Where work is. Neither a stage's share nor the total ever falls, whatever the stages report: one that counts from 0 to 1 several
/// times is in a further pass. Stages may be left out, and others come that the plan does not have.
class WorkTrack {
 public:
  explicit WorkTrack(WorkPlan plan) : plan_(std::move(plan)) {}

  /// Hears what a stage reports, `share` 0..1 of it or of a pass of it.
  void reached(const std::string& stage, double share);

  /// The stage's number of count(), from 1 on; 0 before the first and where the plan is empty.
  [[nodiscard]] std::size_t number() const { return is_planned_ ? current_ + 1 : 0; }
  [[nodiscard]] std::size_t count() const { return plan_.size(); }
  [[nodiscard]] double share() const { return share_; }  ///< of the stage, 0..1
  [[nodiscard]] double total() const { return total_; }  ///< of all, weighted by cost, 0..1

 private:
  void begin(const std::string& stage);

  WorkPlan plan_;
  std::string stage_;
  std::size_t current_ = 0;
  bool is_planned_ = false;
  unsigned pass_ = 0;
  double reported_ = 0.0, share_ = 0.0, total_ = 0.0;
};

/// "12 s", "4 min" or "2 h 10 min": what is left of work of which `share` took this long, if it goes on so; empty in its first
/// seconds, when no one can say.
[[nodiscard]] std::string time_left(double elapsed_s, double share);

}  // namespace splatray
