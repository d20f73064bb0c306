/// How far long work has come: who is told, and one line on a terminal.
#pragma once
#include <functional>
#include <string>

namespace splatray {

/// Hears a stage's name and the share of it done, 0..1, at intervals far below half a second; returns false to stop the
/// work, which then throws Error (interrupted).
using Progress = std::function<bool(const char* stage, double share)>;

/// Writes to stderr, only when that is a terminal; the line is cleared on destruction.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// `share` 0..1. Draws only when the whole per cent or the stage has changed.
  void show(const std::string& stage, double share);
  /// Erases the line, for other output.
  void clear();

 private:
  bool enabled_;
  std::string shown_;
};

}  // namespace splatray
