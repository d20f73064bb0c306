/// The radix sort against std::stable_sort; numbers found in parallel against those found one by one.
#include "preprocess/base/sorted_order.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include "preprocess/base/parallel.h"

namespace splatray {
namespace {

using Keys = std::vector<std::uint64_t>;

/// With later entries first where keys are equal, by any number of threads.
void check_order(const Keys& keys) {
  std::vector<std::uint32_t> expected(keys.size());
  std::iota(expected.rbegin(), expected.rend(), 0U);
  std::stable_sort(expected.begin(), expected.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; });
  for (const std::size_t threads : {1, 2, 5}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_EQ(sorted_order(
                  keys.size(), [&](std::size_t i) { return keys[i]; }, std::greater<>()),
              expected);
  }
}

Keys random_keys(std::size_t count, std::uint64_t mask) {
  std::mt19937_64 random(count);
  Keys keys(count);
  for (std::uint64_t& key : keys) key = random() & mask;
  return keys;
}

TEST(SortedOrder, RandomKeys) {
  for (const std::size_t count : {2, 100, 65536, 200000}) check_order(random_keys(count, ~0ULL));
}

TEST(SortedOrder, NoneAndOne) {
  check_order({});
  check_order({7});
}

TEST(SortedOrder, EqualKeys) {
  check_order(Keys(10000, 0));
  check_order(Keys(10000, ~0ULL));
}

TEST(SortedOrder, FewBitsDiffer) {
  for (const std::uint64_t mask : {1ULL, 1ULL << 63, 0xF0ULL, 0xFULL << 60, 1ULL << 63 | 1ULL, 0x1FFULL})
    check_order(random_keys(70000, mask));
}

TEST(SortedOrder, SortedKeys) {
  Keys keys = random_keys(100000, ~0ULL);
  std::sort(keys.begin(), keys.end());
  check_order(keys);
  std::reverse(keys.begin(), keys.end());
  check_order(keys);
}

TEST(NumbersWhere, AsOneByOne) {
  for (const std::size_t count : {0, 1, 16384, 50001}) {
    const Keys keys = random_keys(count, 3);
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = 0; i < count; ++i) {
      if (keys[i] == 1) expected.push_back(i);
    }
    EXPECT_EQ(numbers_where(count, [&](std::size_t i) { return keys[i] == 1; }), expected);
  }
}

}  // namespace
}  // namespace splatray
