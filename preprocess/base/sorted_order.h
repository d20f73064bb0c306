/// Orders by 64-bit keys: a parallel radix sort.
#pragma once
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace splatray {

/// What is sorted in place of a larger thing.
struct KeyedIndex {
  std::uint64_t key;
  std::uint32_t index;
};

/// Entries whose keys ascend in the bits from `low_bit` on.
struct RoughlySorted {
  std::span<KeyedIndex> entries;
  int low_bit;

  /// Whether the bits that are sorted by are others than those of the entry before.
  [[nodiscard]] bool starts_run(std::size_t i) const {
    return i == 0 || (entries[i].key ^ entries[i - 1].key) >> low_bit != 0;
  }
};

/// Sorts entries by the `bits` or a few more highest of the bits that are not the same in all keys. `spare` is as long as
/// `entries`; the result is in either of them.
[[nodiscard]] RoughlySorted sort_roughly(std::span<KeyedIndex> entries, std::span<KeyedIndex> spare,
                                         int bits);

/// The numbers below `count`, ascending by key_of(i), a 64-bit number, and where keys are equal by less(i, j); it depends on
/// threads only where neither distinguishes two. Fastest where keys are Morton keys of points on surfaces.
template <typename KeyOf, typename Less>
[[nodiscard]] std::vector<std::uint32_t> sorted_order(std::size_t count, const KeyOf& key_of,
                                                      const Less& less) {
  const auto store = std::make_unique_for_overwrite<KeyedIndex[]>(count);
  auto spare = std::make_unique_for_overwrite<KeyedIndex[]>(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    store[i] = {key_of(i), static_cast<std::uint32_t>(i)};
  });
  // A surface passes through about n^2 of n^3 cells; a few bits more keep most of its points apart.
  const int bits = 3 * std::bit_width(count) / 2 + 6;
  const RoughlySorted rough = sort_roughly({store.get(), count}, {spare.get(), count}, bits);
  // All runs are found before one is sorted, so that no task reads what another moves.
  constexpr std::size_t CHUNK = 4096;
  std::vector<std::size_t> first(count / CHUNK + 2,
                                 count);  // of the runs that start in each chunk or after it
  const auto each_chunk = [&](const auto& body) {
    tbb::parallel_for(std::size_t{0}, first.size() - 1, body);
  };
  each_chunk([&](std::size_t chunk) {
    const std::size_t end = std::min((chunk + 1) * CHUNK, count);
    std::size_t i = chunk * CHUNK;
    while (i < end && !rough.starts_run(i)) ++i;
    if (i < end) first[chunk] = i;
  });
  for (std::size_t chunk = first.size() - 1; chunk-- > 0;)
    first[chunk] = std::min(first[chunk], first[chunk + 1]);
  each_chunk([&](std::size_t chunk) {
    for (std::size_t begin = first[chunk]; begin < first[chunk + 1];) {
      std::size_t end = begin + 1;
      while (end < first[chunk + 1] && !rough.starts_run(end)) ++end;
      const std::span<KeyedIndex> run = rough.entries.subspan(begin, end - begin);
      begin = end;
      if (run.size() == 1) continue;
      tbb::parallel_sort(run.begin(), run.end(), [&less](const KeyedIndex& a, const KeyedIndex& b) {
        return a.key != b.key ? a.key < b.key : less(a.index, b.index);
      });
    }
  });
  std::vector<std::uint32_t> order(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) { order[i] = rough.entries[i].index; });
  return order;
}

}  // namespace splatray
