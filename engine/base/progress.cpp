#include "engine/base/progress.h"

#include <unistd.h>

#include <cstdio>

namespace splatray {

ProgressLine::ProgressLine(bool quiet, ProgressStyle style)
    : enabled_(!quiet && (style != ProgressStyle::line || isatty(STDERR_FILENO) != 0)), style_(style) {}

ProgressLine::~ProgressLine() { clear(); }

void ProgressLine::show(const std::string& stage, double share) {
  if (!enabled_) return;
  const int percent = static_cast<int>(100.0 * share);
  const std::string line = stage + " " + std::to_string(percent) + " %";
  if (line == shown_) return;
  shown_ = line;
  switch (style_) {
    case ProgressStyle::line:
      std::fprintf(stderr, "\r\033[K%s", line.c_str());
      break;
    case ProgressStyle::plain:
      std::fprintf(stderr, "%s\n", line.c_str());
      break;
    case ProgressStyle::json:
      std::fprintf(stderr, "{\"stage\": \"%s\", \"share\": %d.%02d}\n", stage.c_str(), percent / 100,
                   percent % 100);
      break;
    case ProgressStyle::openjd:
      std::printf("openjd_status: %s\nopenjd_progress: %d\n", stage.c_str(), percent);
      std::fflush(stdout);
      break;
  }
}

void ProgressLine::clear() {
  if (shown_.empty()) return;
  shown_.clear();
  if (style_ == ProgressStyle::line) std::fputs("\r\033[K", stderr);
}

}  // namespace splatray
