#include "engine/base/error.h"

#include <gtest/gtest.h>

#include <new>

namespace splatray {
namespace {

int run_and_expect(int (*body)(int, char**), const std::string& sentence) {
  ::testing::internal::CaptureStderr();
  const int code = run_main("program", body, 0, nullptr);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), sentence);
  return code;
}

TEST(RunMain, PassesTheBodysCode) {
  EXPECT_EQ(run_and_expect([](int, char**) { return 7; }, ""), 7);
}

TEST(RunMain, ReportsAnErrorInOneLine) {
  const auto body = [](int, char**) -> int { throw Error(ExitCode::input_unreadable, "no '\x1B\nfile'"); };
  EXPECT_EQ(run_and_expect(body, "program: error: no '??file'\n"), 3);
}

TEST(RunMain, ReportsExhaustedMemory) {
  const auto body = [](int, char**) -> int { throw std::bad_alloc(); };
  EXPECT_EQ(run_and_expect(body, "program: error: out of memory\n"), 5);
}

TEST(RunMain, FailsOnOtherExceptions) {
  const auto body = [](int, char**) -> int { throw std::runtime_error("odd\n"); };
  EXPECT_EQ(run_and_expect(body, "program: error: odd?\n"), 1);
}

}  // namespace
}  // namespace splatray
