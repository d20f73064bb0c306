/// Which tests run: those that a landing must see, or all.
#pragma once
#include <cstdlib>

namespace splatray::testing {

/// Whether long cases and long statistics are asked for (the variable SPLATRAY_TEST_ALL; tests/run --all).
[[nodiscard]] inline bool all_tests() { return std::getenv("SPLATRAY_TEST_ALL") != nullptr; }

/// `all` of what is counted with all tests, `some` otherwise.
template <typename Number>
[[nodiscard]] Number all_or(Number all, Number some) {
  return all_tests() ? all : some;
}

}  // namespace splatray::testing

/// Skips the rest of a long test unless all are asked for.
#define SPLATRAY_NIGHTLY() \
  if (!::splatray::testing::all_tests()) GTEST_SKIP() << "long: with tests/run --all"
