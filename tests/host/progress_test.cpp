#include "engine/base/progress.h"

#include <gtest/gtest.h>

#include <thread>

namespace splatray {
namespace {

/// What is reported of work that takes `wait`, on a stderr that is no terminal.
std::string report_of(bool quiet, std::chrono::seconds wait) {
  ::testing::internal::CaptureStderr();
  {
    ProgressLine line(quiet);
    line.show("tracing", 0.0);
    std::this_thread::sleep_for(wait);
    for (int i = 1; i <= 10; ++i) line.show("tracing", 0.1 * i);
  }
  return ::testing::internal::GetCapturedStderr();
}

TEST(Progress, IsALineInSomeSecondsWithoutATerminal) {
  EXPECT_EQ(report_of(false, std::chrono::seconds(0)), "") << "short work says nothing";
  EXPECT_EQ(report_of(true, std::chrono::seconds(10)), "");
  EXPECT_EQ(report_of(false, std::chrono::seconds(1)), "tracing 0 %\n");
}

TEST(WorkTrack, WeighsStagesAndNeverFalls) {
  WorkTrack track({{"reading", 1.0}, {"normals", 8.0, 2}, {"tracing", 1.0}});
  EXPECT_EQ(track.number(), 0U);
  EXPECT_EQ(track.count(), 3U);
  track.reached("reading", 0.5);
  EXPECT_EQ(track.number(), 1U);
  EXPECT_DOUBLE_EQ(track.total(), 0.05);
  track.reached("normals", 0.5);
  EXPECT_EQ(track.number(), 2U);
  EXPECT_DOUBLE_EQ(track.share(), 0.25) << "half of the first of two passes";
  EXPECT_DOUBLE_EQ(track.total(), 0.3);
  for (int pass = 0; pass < 5; ++pass)
    for (const double share : {0.0, 0.4, 1.0}) {
      const double before = track.share(), total = track.total();
      track.reached("normals", share);
      EXPECT_GE(track.share(), before);
      EXPECT_GE(track.total(), total);
    }
  EXPECT_DOUBLE_EQ(track.total(), 0.9);
  track.reached("sorting", 0.5);
  EXPECT_EQ(track.number(), 0U) << "no stage of the plan";
  EXPECT_DOUBLE_EQ(track.total(), 0.9);
  track.reached("reading", 0.5);
  EXPECT_EQ(track.number(), 1U) << "another input";
  EXPECT_DOUBLE_EQ(track.total(), 0.9);
  track.reached("tracing", 1.0);
  EXPECT_DOUBLE_EQ(track.total(), 1.0);
}

TEST(TimeLeft, IsSaidOnceItIsKnown) {
  EXPECT_EQ(time_left(2.0, 0.5), "") << "too early";
  EXPECT_EQ(time_left(30.0, 0.01), "") << "too little done";
  EXPECT_EQ(time_left(30.0, 1.0), "");
  EXPECT_EQ(time_left(10.0, 0.5), "10 s");
  EXPECT_EQ(time_left(60.0, 0.2), "4 min");
  EXPECT_EQ(time_left(3600.0, 0.25), "3 h 0 min");
}

TEST(Progress, OfAPlanSaysTheStagesNumber) {
  ::testing::internal::CaptureStderr();
  {
    ProgressLine line(false, ProgressStyle::plain, {{"reading", 1.0}, {"tracing", 1.0}});
    line.show("reading", 1.0);
    line.show("tracing", 0.5, "frame 7");
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "1/2 reading 100 %\n2/2 frame 7 50 %\n");
}

}  // namespace
}  // namespace splatray
