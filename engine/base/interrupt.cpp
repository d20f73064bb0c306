#include "engine/base/interrupt.h"

#include <unistd.h>

#include <csignal>

#include "engine/base/error.h"

namespace splatray {
namespace {

constexpr unsigned PATIENCE_S = 2;

volatile std::sig_atomic_t signal_came = 0;

void on_signal(int) {
  signal_came = 1;
  alarm(PATIENCE_S);
}

void on_alarm(int) {
  constexpr char SENTENCE[] = "error: interrupted by a signal, the work was not waited for\n";
  (void)!write(STDERR_FILENO, SENTENCE, sizeof SENTENCE - 1);
  _exit(static_cast<int>(ExitCode::interrupted));
}

}  // namespace

void catch_interrupts() {
  struct sigaction action = {};
  action.sa_handler = on_signal;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction end = {};
  end.sa_handler = on_alarm;
  sigaction(SIGALRM, &end, nullptr);
  struct sigaction hangup = {};
  sigaction(SIGHUP, nullptr, &hangup);
  if (hangup.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
}

bool interrupted() { return signal_came != 0; }

void take_time_to_end() { alarm(0); }

void stop_if_interrupted() {
  if (interrupted()) throw Error(ExitCode::interrupted, "interrupted by a signal");
}

}  // namespace splatray
