#include "preprocess/base/sorted_order.h"

#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <utility>

namespace splatray {
namespace {

constexpr int DIGIT_BITS = 11;
constexpr std::size_t DIGIT_VALUES = std::size_t{1} << DIGIT_BITS;
constexpr std::size_t ENTRIES_PER_TASK = std::size_t{1} << 16;  // entries that one task counts and moves

using EntryRange = tbb::blocked_range<std::size_t>;
using DigitPlaces = std::array<std::uint32_t, DIGIT_VALUES>;

std::size_t digit(const KeyedIndex& entry, int shift) { return entry.key >> shift & (DIGIT_VALUES - 1); }

/// The bits that are not the same in all keys.
std::uint64_t differing_bits(std::span<const KeyedIndex> entries) {
  const auto add = [&](const EntryRange& range, std::uint64_t bits) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) bits |= entries[i].key ^ entries[0].key;
    return bits;
  };
  const auto join = [](std::uint64_t a, std::uint64_t b) { return a | b; };
  return tbb::parallel_reduce(EntryRange(0, entries.size(), ENTRIES_PER_TASK), std::uint64_t{0}, add, join);
}

/// Counts turned into where the first entry of each digit of each chunk goes.
void add_up(std::vector<DigitPlaces>& places) {
  std::uint32_t next = 0;
  for (std::size_t d = 0; d < DIGIT_VALUES; ++d) {
    for (DigitPlaces& chunk : places) next += std::exchange(chunk[d], next);
  }
}

/// Stable, so that passes from the lowest digit on sort.
void sort_by_digit(std::span<const KeyedIndex> from, std::span<KeyedIndex> to, int shift,
                   std::vector<DigitPlaces>& places) {
  const auto entries_of = [&](std::size_t chunk) {
    return from.subspan(chunk * ENTRIES_PER_TASK,
                        std::min(ENTRIES_PER_TASK, from.size() - chunk * ENTRIES_PER_TASK));
  };
  tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t chunk) {
    places[chunk].fill(0);
    for (const KeyedIndex& entry : entries_of(chunk)) ++places[chunk][digit(entry, shift)];
  });
  add_up(places);
  tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t chunk) {
    for (const KeyedIndex& entry : entries_of(chunk)) to[places[chunk][digit(entry, shift)]++] = entry;
  });
}

}  // namespace

RoughlySorted sort_roughly(std::span<KeyedIndex> entries, std::span<KeyedIndex> spare, int bits) {
  if (entries.empty()) return {entries, 0};
  const int width = std::bit_width(differing_bits(entries));
  const int passes = (std::min(bits, width) + DIGIT_BITS - 1) / DIGIT_BITS;
  const int low_bit = std::max(width - passes * DIGIT_BITS, 0);
  std::vector<DigitPlaces> places((entries.size() + ENTRIES_PER_TASK - 1) / ENTRIES_PER_TASK);
  for (int pass = 0; pass < passes; ++pass) {
    sort_by_digit(entries, spare, low_bit + pass * DIGIT_BITS, places);
    std::swap(entries, spare);
  }
  return {entries, std::min(low_bit, 63)};
}

}  // namespace splatray
