#include "engine/base/interrupt.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <ctime>
#include <string_view>

#include "engine/base/error.h"

namespace splatray {
namespace {

constexpr unsigned PATIENCE_S = 2;
/// Signals so near are one: timeout(1) sends each to the program and once more to its group, a closed terminal SIGHUP twice.
constexpr std::int64_t ONE_SIGNAL_MS = 200;

std::atomic<std::int64_t> first_signal_ms{0};  ///< 0: none came
std::atomic<bool> patient{false};
std::atomic<void (*)()> clean_up{nullptr};

std::int64_t now_ms() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1000 + now.tv_nsec / 1000000 + 1;
}

void write_error(std::string_view text) { (void)!write(STDERR_FILENO, text.data(), text.size()); }

[[noreturn]] void end_at_once(std::string_view sentence) {
  if (void (*clean)() = clean_up) clean();
  write_error(program_invocation_short_name);
  write_error(sentence);
  _exit(static_cast<int>(ExitCode::interrupted));
}

void on_signal(int) {
  std::int64_t first = 0;
  const std::int64_t now = now_ms();
  if (first_signal_ms.compare_exchange_strong(first, now)) {
    if (!patient) alarm(PATIENCE_S);
  } else if (now - first > ONE_SIGNAL_MS) {
    end_at_once(": error: interrupted by a second signal\n");
  }
}

void on_alarm(int) { end_at_once(": error: interrupted by a signal, the work was not waited for\n"); }

}  // namespace

void catch_interrupts() {
  struct sigaction action = {};
  action.sa_handler = on_signal;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction end = {};
  end.sa_handler = on_alarm;
  sigaction(SIGALRM, &end, nullptr);
  struct sigaction hangup = {};
  sigaction(SIGHUP, nullptr, &hangup);
  if (hangup.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
}

bool interrupted() { return first_signal_ms != 0; }

void take_time_to_end() {
  patient = true;
  alarm(0);
}

void stop_if_interrupted() {
  if (interrupted()) throw Error(ExitCode::interrupted, "interrupted by a signal");
}

void at_abrupt_end(void (*clean)()) { clean_up = clean; }

}  // namespace splatray
