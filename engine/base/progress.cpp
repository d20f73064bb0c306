#include "engine/base/progress.h"

#include <unistd.h>

#include <cstdio>

namespace splatray {

ProgressLine::ProgressLine(bool quiet) : enabled_(!quiet && isatty(STDERR_FILENO) != 0) {}

ProgressLine::~ProgressLine() { clear(); }

void ProgressLine::show(const std::string& stage, double share) {
  if (!enabled_) return;
  const std::string line = stage + " " + std::to_string(static_cast<int>(100.0 * share)) + " %";
  if (line == shown_) return;
  shown_ = line;
  std::fprintf(stderr, "\r\033[K%s", line.c_str());
}

void ProgressLine::clear() {
  if (shown_.empty()) return;
  shown_.clear();
  std::fputs("\r\033[K", stderr);
}

}  // namespace splatray
