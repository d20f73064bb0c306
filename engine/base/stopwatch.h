/// Wall time.
#pragma once
#include <chrono>

namespace splatray {

/// Milliseconds since a point in time of the steady clock.
[[nodiscard]] inline double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// Wall time of consecutive stages.
class Stopwatch {
 public:
  /// Milliseconds since construction or the last lap.
  double lap_ms() {
    const double ms = milliseconds_since(last_);
    last_ = std::chrono::steady_clock::now();
    return ms;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Adds the time since its construction to a number of milliseconds when it ends.
class AddedTime {
 public:
  explicit AddedTime(double& total_ms) : total_ms_(total_ms) {}
  AddedTime(const AddedTime&) = delete;
  AddedTime& operator=(const AddedTime&) = delete;
  ~AddedTime() { total_ms_ += milliseconds_since(start_); }

 private:
  double& total_ms_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace splatray
