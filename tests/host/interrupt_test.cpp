#include "engine/base/interrupt.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "engine/base/stopwatch.h"

namespace splatray {
namespace {

/// The exit code of a child that gets a SIGTERM and then runs body(); -1 where a signal ended it.
template <typename Body>
int code_of_child(const Body& body) {
  const pid_t child = fork();
  if (child == 0) {
    catch_interrupts();
    (void)raise(SIGTERM);
    _exit(body());
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(Interrupt, IsAskedFor) {
  EXPECT_EQ(code_of_child([] { return interrupted() ? 7 : 8; }), 7);
}

TEST(Interrupt, WorkThatDoesNotAskEndsInThreeSeconds) {
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(code_of_child([] {
              for (volatile bool on = true; on;) {
              }
              return 0;
            }),
            130);
  EXPECT_LT(milliseconds_since(start), 3000.0);
}

}  // namespace
}  // namespace splatray
