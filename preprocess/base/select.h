/// Selection by rank, as std::nth_element but without a branch per value that CPUs cannot predict.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <span>
#include <type_traits>
#include <vector>

namespace splatray {

/// Moves the values that a test is true of to the front and returns how many they are.
template <typename Value, typename Test>
std::size_t partition_by(std::span<Value> values, const Test& test) {
  std::size_t passed = 0;
  for (Value& value : values) {
    const Value copy = value;
    value = values[passed];
    values[passed] = copy;
    passed += static_cast<std::size_t>(test(copy));
  }
  return passed;
}

/// A key of the values that lies a little beyond the nth smallest, as seen from the nearer end: guessed from a sample.
template <typename Value, typename Key>
auto guess_pivot(std::span<const Value> values, std::size_t nth, const Key& key) {
  constexpr std::size_t MOST = 128;
  std::array<std::decay_t<decltype(key(values[0]))>, MOST> sample;
  const std::size_t count = std::min(MOST, static_cast<std::size_t>(std::sqrt(values.size())));
  for (std::size_t i = 0; i < count; ++i) sample[i] = key(values[i * values.size() / count]);
  std::sort(sample.begin(), sample.begin() + static_cast<std::ptrdiff_t>(count));
  const double share = static_cast<double>(nth) / static_cast<double>(values.size());
  const double beyond = std::sqrt(static_cast<double>(count) * share * (1.0 - share));
  const double rank = share * static_cast<double>(count) + (share < 0.5 ? beyond : -beyond);
  return sample[std::min(static_cast<std::size_t>(std::max(rank, 0.0)), count - 1)];
}

/// Puts at values[nth] what sorting by key would put there, none larger before it and none smaller after it.
template <typename Value, typename Key>
void select_nth(std::span<Value> values, std::size_t nth, const Key& key) {
  constexpr std::size_t FEW = 32;
  constexpr int MOST_ROUNDS = 64;  // guesses that go wrong again and again are not worth more
  for (int round = 0; values.size() > FEW && round < MOST_ROUNDS; ++round) {
    const auto pivot = guess_pivot(std::span<const Value>(values), nth, key);
    std::size_t split = partition_by(values, [&](const Value& value) { return key(value) < pivot; });
    if (split == 0) {  // the pivot is the smallest
      split = partition_by(values, [&](const Value& value) { return !(pivot < key(value)); });
      if (nth < split) return;
    }
    const bool before = nth < split;
    values = before ? values.first(split) : values.subspan(split);
    nth -= before ? 0 : split;
  }
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(nth), values.end(),
                   [&](const Value& a, const Value& b) { return key(a) < key(b); });
}

/// The fewest points whose medians show what is usual in a scan.
inline constexpr std::size_t FEWEST_TELLING = 1000;

/// The value of the middle rank, of an even number of values the larger; changes their order. There must be one.
template <typename Value>
[[nodiscard]] Value median_of(std::span<Value> values) {
  select_nth(values, values.size() / 2, std::identity());
  return values[values.size() / 2];
}

/// median_of, zero where there is no value.
template <typename Value>
[[nodiscard]] Value median_or_zero(std::vector<Value>& values) {
  return values.empty() ? Value{0} : median_of(std::span(values));
}

}  // namespace splatray
