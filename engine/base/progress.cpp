#include "engine/base/progress.h"

#include <unistd.h>

#include <chrono>
#include <cstdio>

namespace splatray {
namespace {

using Clock = std::chrono::steady_clock;

bool is_terminal() { return isatty(STDERR_FILENO) != 0; }

/// Whether it is time for another line on a stderr that is no terminal: one in some seconds, and none of work that is short.
bool is_time_for_a_line() {
  constexpr auto PAUSE = std::chrono::seconds(10);
  static Clock::time_point last = Clock::now();  // of the process, as stderr is
  if (Clock::now() - last < PAUSE) return false;
  last = Clock::now();
  return true;
}

}  // namespace

ProgressLine::ProgressLine(bool quiet, ProgressStyle style) : enabled_(!quiet), style_(style) {}

ProgressLine::~ProgressLine() { clear(); }

void ProgressLine::show(const std::string& stage, double share) {
  if (!enabled_) return;
  const int percent = static_cast<int>(100.0 * share);
  const std::string line = stage + " " + std::to_string(percent) + " %";
  if (line == shown_) return;
  if (style_ == ProgressStyle::line && !is_terminal()) {
    if (!is_time_for_a_line()) return;
    std::fprintf(stderr, "%s\n", line.c_str());
    shown_ = line;
    return;
  }
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
  if (style_ == ProgressStyle::line && is_terminal()) std::fputs("\r\033[K", stderr);
}

}  // namespace splatray
