#include "engine/base/interrupt.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>

#include "engine/base/stopwatch.h"
#include "engine/file/atomic_file.h"
#include "tests/temp_folder.h"

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

/// Waits, as long as a signal's handler takes it.
void wait_ms(double ms) {
  const auto start = std::chrono::steady_clock::now();
  while (milliseconds_since(start) < ms) usleep(1000);
}

TEST(Interrupt, WorkWithMuchToLoseHasItsTime) {
  EXPECT_EQ(code_of_child([] {
              take_time_to_end();
              wait_ms(2500.0);
              return 7;
            }),
            7)
      << "also where the signal came first";
  const auto before = [] {
    const pid_t child = fork();
    if (child == 0) {
      catch_interrupts();
      take_time_to_end();
      (void)raise(SIGINT);
      wait_ms(2500.0);
      _exit(interrupted() ? 7 : 8);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  };
  EXPECT_EQ(before(), 7);
}

TEST(Interrupt, ASecondSignalOfAnyKindEndsAtOnce) {
  const auto start = std::chrono::steady_clock::now();
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(code_of_child([] {
              take_time_to_end();
              wait_ms(300.0);
              (void)raise(SIGINT);
              return 7;
            }),
            130);
  EXPECT_LT(milliseconds_since(start), 1500.0);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "test_host: error: interrupted by a second signal\n");
}

TEST(Interrupt, OneThatComesTwiceAtOnceIsOne) {
  EXPECT_EQ(code_of_child([] {
              (void)raise(SIGTERM);
              return interrupted() ? 7 : 8;
            }),
            7)
      << "as timeout(1) sends it";
}

TEST(Interrupt, WhatIsHalfWrittenGoesWithIt) {
  const TempFolder folder;
  EXPECT_EQ(code_of_child([&] {
              take_time_to_end();
              AtomicFile file(folder.path() / "a"), other(folder.path() / "b");
              file.write("half", 4);
              AtomicFile(folder.path() / "c").commit();
              wait_ms(300.0);
              (void)raise(SIGTERM);
              return 7;
            }),
            130);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1) << "c is whole";
}

}  // namespace
}  // namespace splatray
