/// How far long work has come: the callback that hears it, and one line on a terminal.
#pragma once
#include <chrono>
#include <functional>
#include <string>

#include "engine/base/work_plan.h"

namespace splatray {

/// Called several times a second with a stage's name and the fraction of it done, 0..1; returns false to stop the work, which
/// then throws Error (interrupted).
using Progress = std::function<bool(const char* stage, double share)>;

/// How progress is reported.
enum class ProgressStyle {
  line,    ///< on a terminal, a line on stderr that changes
  plain,   ///< lines on stderr
  json,    ///< a JSON object a line, on stderr: "stage", its "share", and the "total" of work that has a plan
  openjd,  ///< on stdout as workers of Open Job Description read it (specification 2023-09, "openjd_progress")
};

/// Reports progress in a style; a line that changes, only on a terminal, is cleared on destruction. Of work with a plan it says the
/// stage's number, and after some seconds how long all will still take: "2/8 normals 40 %, 12 s left".
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet, ProgressStyle style = ProgressStyle::line, WorkPlan plan = {});
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// `share` 0..1. Draws only when the whole per cent or the stage has changed. `label`: what the line calls the stage; empty: so.
  void show(const std::string& stage, double share, const std::string& label = "");
  /// Erases the line, for other output.
  void clear();

 private:
  /// "2/8 normals 40 %".
  [[nodiscard]] std::string place(const std::string& label) const;
  void draw(const std::string& label) const;

  bool enabled_;
  ProgressStyle style_;
  WorkTrack track_;
  std::chrono::steady_clock::time_point begin_;
  std::string shown_;
};

}  // namespace splatray
