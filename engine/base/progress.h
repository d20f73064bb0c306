/// One line on a terminal that tells how far long work has come.
#pragma once
#include <string>

namespace splatray {

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
