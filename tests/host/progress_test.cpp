#include "engine/base/progress.h"

#include <gtest/gtest.h>

#include <thread>

namespace splatray {
namespace {

/// What is reported of work that takes `wait`, on a stderr that is no terminal.
std::string report_of(bool quiet, std::chrono::seconds wait) {
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
  EXPECT_EQ(report_of(false, std::chrono::seconds(0)), "") << "short work says nothing";
  EXPECT_EQ(report_of(true, std::chrono::seconds(10)), "");
  EXPECT_EQ(report_of(false, std::chrono::seconds(1)), "tracing 0 %\n");
}

}  // namespace
}  // namespace splatray
