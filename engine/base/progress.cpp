#include "engine/base/progress.h"

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <utility>

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

int percent_of(double share) { return static_cast<int>(100.0 * share); }

/// A whole per cent as JSON writes a fraction: "0.40".
std::string share_text(int percent) {
  return std::to_string(percent / 100) + (percent % 100 < 10 ? ".0" : ".") + std::to_string(percent % 100);
}

}  // namespace

ProgressLine::ProgressLine(bool quiet, ProgressStyle style, WorkPlan plan)
    : enabled_(!quiet), style_(style), track_(std::move(plan)), begin_(Clock::now()) {}

ProgressLine::~ProgressLine() { clear(); }

std::string ProgressLine::place(const std::string& label) const {
  const std::string number =
      track_.number() == 0 || track_.count() < 2
          ? ""
          : std::to_string(track_.number()) + "/" + std::to_string(track_.count()) + " ";
  return number + label + " " + std::to_string(percent_of(track_.share())) + " %";
}

void ProgressLine::show(const std::string& stage, double share, const std::string& label) {
  if (!enabled_) return;
  track_.reached(stage, share);
  const std::string name = label.empty() ? stage : label;
  const std::string now = place(name);
  if (now == shown_) return;
  if (style_ == ProgressStyle::line && !is_terminal() && !is_time_for_a_line()) return;
  shown_ = now;
  draw(name);
}

void ProgressLine::draw(const std::string& label) const {
  const bool has_total = track_.number() > 0;
  const int total = percent_of(track_.total());
  const std::string left =
      time_left(std::chrono::duration<double>(Clock::now() - begin_).count(), track_.total());
  const std::string line = shown_ + (left.empty() ? "" : ", " + left + " left");
  switch (style_) {
    case ProgressStyle::line:
      std::fprintf(stderr, is_terminal() ? "\r\033[K%s" : "%s\n", line.c_str());
      break;
    case ProgressStyle::plain:
      std::fprintf(stderr, "%s\n", line.c_str());
      break;
    case ProgressStyle::json:
      std::fprintf(stderr, "{\"stage\": \"%s\", \"share\": %s%s}\n", label.c_str(),
                   share_text(percent_of(track_.share())).c_str(),
                   has_total ? (", \"total\": " + share_text(total)).c_str() : "");
      break;
    case ProgressStyle::openjd:
      std::printf("openjd_status: %s\nopenjd_progress: %d\n", label.c_str(),
                  has_total ? total : percent_of(track_.share()));
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
