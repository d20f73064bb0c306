/// How far long work has come: the callback that hears it, and one line on a terminal.
#pragma once
#include <functional>
#include <string>

namespace splatray {

/// Hears a stage's name and the share of it done, 0..1, at intervals far below half a second; returns false to stop the
/// work, which then throws Error (interrupted).
using Progress = std::function<bool(const char* stage, double share)>;

/// How progress is reported.
enum class ProgressStyle {
  line,    ///< on a terminal, a line on stderr that changes
  plain,   ///< lines on stderr
  json,    ///< a JSON object a line, on stderr: "stage", "share"
  openjd,  ///< on stdout as workers of Open Job Description read it (specification 2023-09, "openjd_progress")
};

/// Reports progress in a style; a line that changes, only on a terminal, is cleared on destruction.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet, ProgressStyle style = ProgressStyle::line);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// `share` 0..1. Draws only when the whole per cent or the stage has changed.
  void show(const std::string& stage, double share);
  /// Erases the line, for other output.
  void clear();

 private:
  bool enabled_;
  ProgressStyle style_;
  std::string shown_;
};

}  // namespace splatray
