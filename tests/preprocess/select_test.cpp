/// Selection by rank against sorting.
#include "preprocess/base/select.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace splatray {
namespace {

void check_select(const std::vector<float>& values) {
  std::vector<float> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  for (const std::size_t nth : {std::size_t{0}, values.size() / 3, values.size() / 2, values.size() - 1}) {
    std::vector<float> selected = values;
    select_nth(std::span(selected), nth, [](float value) { return value; });
    EXPECT_EQ(selected[nth], sorted[nth]);
    for (std::size_t i = 0; i < nth; ++i) ASSERT_LE(selected[i], selected[nth]);
    for (std::size_t i = nth; i < selected.size(); ++i) ASSERT_GE(selected[i], selected[nth]);
    std::sort(selected.begin(), selected.end());
    EXPECT_EQ(selected, sorted) << "nothing is lost";
  }
}

std::vector<float> random_values(std::size_t count, int different) {
  std::mt19937 random(static_cast<std::mt19937::result_type>(count));
  std::uniform_int_distribution<int> value(0, different - 1);
  std::vector<float> values(count);
  for (float& v : values) v = static_cast<float>(value(random));
  return values;
}

TEST(Select, RandomValues) {
  for (const std::size_t count : {1, 2, 33, 1000, 50000}) check_select(random_values(count, 1 << 20));
}

TEST(Select, FewDifferentValues) {
  for (const int different : {1, 2, 3, 10}) check_select(random_values(5000, different));
}

TEST(Select, SortedValues) {
  std::vector<float> values = random_values(20000, 1 << 20);
  std::sort(values.begin(), values.end());
  check_select(values);
  std::reverse(values.begin(), values.end());
  check_select(values);
}

}  // namespace
}  // namespace splatray
