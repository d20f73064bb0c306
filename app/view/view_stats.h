/// What a run of the viewer did, for people who measure it.
#pragma once
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/view/thread/progressive.h"

namespace splatray {

/// Counts pictures as they come into the window.
class ViewStats {
 public:
  using Clock = std::chrono::steady_clock;

  /// `now` = the program's start.
  explicit ViewStats(Clock::time_point now) : start_(now) {}

  void shown(const SharedFrame& frame, Clock::time_point now);
  /// `error`: the sentence that the window shows as its error, in every frame.
  void add_error(const std::string& error);
  /// Whether an error, the first picture, or one that is not of something moving, came since the last write().
  [[nodiscard]] bool has_news() const { return has_news_; }
  /// Pictures of the last second that were handed to the window.
  [[nodiscard]] double per_second(Clock::time_point now) const;
  /// Writes JSON: device, time to the first picture and to that of points before it (0 = none), pictures and their rate while something moved, size and samples of
  /// the last picture, pools uploaded, errors shown, validation messages. Throws Error (failed); leaves no partial file.
  void write(const std::filesystem::path& path, std::uint32_t validation_messages);

 private:
  Clock::time_point start_;
  std::optional<double> first_ms_, first_points_ms_;  ///< of the scene, and of the points before it
  std::uint64_t pictures_ = 0, point_pictures_ = 0, moving_pictures_ = 0;
  double moving_ms_ = 0.0;                 ///< between pictures that followed each other in motion
  double scale_sum_ = 0.0;                 ///< of moving_pictures_
  std::vector<Clock::time_point> recent_;  ///< of the last second
  Clock::time_point last_{};
  SharedFrame frame_;
  std::vector<std::string> errors_;
  bool has_news_ = false;
};

}  // namespace splatray
