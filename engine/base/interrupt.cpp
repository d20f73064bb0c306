#include "engine/base/interrupt.h"

#include <csignal>

#include "engine/base/error.h"

namespace splatray {
namespace {

volatile std::sig_atomic_t signal_came = 0;

}  // namespace

void catch_interrupts() {
  struct sigaction action = {};
  action.sa_handler = [](int) { signal_came = 1; };
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction hangup = {};
  sigaction(SIGHUP, nullptr, &hangup);
  if (hangup.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
}

bool interrupted() { return signal_came != 0; }

void stop_if_interrupted() {
  if (interrupted()) throw Error(ExitCode::interrupted, "interrupted by a signal");
}

}  // namespace splatray
