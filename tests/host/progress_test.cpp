#include "engine/base/progress.h"

#include <gtest/gtest.h>

#include <thread>

namespace splatray {
namespace {

/// What is told of work that takes so long, on a stderr that is no terminal.
std::string told(bool quiet, std::chrono::seconds wait) {
  testing::internal::CaptureStderr();
  {
    ProgressLine line(quiet);
    line.show("tracing", 0.0);
    std::this_thread::sleep_for(wait);
    for (int i = 1; i <= 10; ++i) line.show("tracing", 0.1 * i);
  }
  return testing::internal::GetCapturedStderr();
}

TEST(Progress, IsALineInSomeSecondsWithoutATerminal) {
  EXPECT_EQ(told(false, std::chrono::seconds(0)), "") << "short work says nothing";
  EXPECT_EQ(told(true, std::chrono::seconds(10)), "");
  EXPECT_EQ(told(false, std::chrono::seconds(1)), "tracing 0 %\n");
}

}  // namespace
}  // namespace splatray
