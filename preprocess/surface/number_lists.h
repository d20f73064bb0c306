/// Lists of points for each point, in little memory.
#pragma once
#include <tbb/concurrent_vector.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "engine/base/release.h"

namespace splatray {

/// COUNT numbers of points for each point. Most numbers around a point of a cloud in canonical order are near its own: lists of
/// these take 2 bytes a number, others 6.
template <std::size_t COUNT>
class NumberLists {
 public:
  static_assert(COUNT >= 3, "the place of a list that is kept elsewhere takes three steps");
  using List = std::array<std::uint32_t, COUNT>;

  NumberLists() = default;
  /// Lists that are still to be set.
  explicit NumberLists(std::size_t points) {
    for (std::size_t begin = 0; begin < points; begin += CHUNK)
      chunks_.emplace_back(std::min(CHUNK, points - begin));
  }

  [[nodiscard]] List operator[](std::size_t point) const {
    const Steps& steps = steps_of(point);
    if (steps[0] == FAR) return far_[place_of(steps)];
    List list;
    for (std::size_t j = 0; j < COUNT; ++j) list[j] = after(point, steps[j]);
    return list;
  }
  /// The k-th number of a point's list.
  [[nodiscard]] std::uint32_t at(std::size_t point, std::size_t k) const {
    const Steps& steps = steps_of(point);
    return steps[0] == FAR ? far_[place_of(steps)][k] : after(point, steps[k]);
  }

  /// Sets a point's list, once; from many threads.
  void set(std::uint32_t point, const List& list) {
    Steps& steps = chunks_[point / CHUNK][point % CHUNK];
    bool near = true;
    for (std::size_t j = 0; j < COUNT; ++j) {
      const auto step = static_cast<std::int64_t>(list[j]) - static_cast<std::int64_t>(point);
      near = near && step > FAR && step <= std::numeric_limits<std::int16_t>::max();
      steps[j] = static_cast<std::int16_t>(step);
    }
    if (near) return;
    const auto place = static_cast<std::uint32_t>(far_.push_back(list) - far_.begin());
    steps[0] = FAR;
    steps[1] = static_cast<std::int16_t>(place & 0xFFFFU);
    steps[2] = static_cast<std::int16_t>(place >> 16U);
  }

  /// Leaves the lists of the points `kept`, ascending: the n-th becomes renumbered(n, its list).
  template <typename Renumbered>
  void keep(const std::vector<std::uint32_t>& kept, const Renumbered& renumbered) {
    NumberLists before = std::exchange(*this, NumberLists());
    for (std::size_t begin = 0, freed = 0; begin < kept.size(); begin += CHUNK) {
      const std::size_t end = std::min(begin + CHUNK, kept.size());
      chunks_.emplace_back(end - begin);
      tbb::parallel_for(begin, end, [&](std::size_t n) {
        set(static_cast<std::uint32_t>(n), renumbered(static_cast<std::uint32_t>(n), before[kept[n]]));
      });
      for (; freed < kept[end - 1] / CHUNK; ++freed) release(before.chunks_[freed]);
    }
  }

 private:
  static constexpr std::size_t CHUNK = std::size_t{1} << 15;  // points whose lists are in one array
  static constexpr std::int16_t FAR =
      std::numeric_limits<std::int16_t>::min();  // first step of a list in far_

  using Steps = std::array<std::int16_t, COUNT>;  // from the point's own number

  [[nodiscard]] const Steps& steps_of(std::size_t point) const {
    return chunks_[point / CHUNK][point % CHUNK];
  }
  static std::uint32_t after(std::size_t point, std::int16_t step) {
    return static_cast<std::uint32_t>(point) + static_cast<std::uint32_t>(std::int32_t{step});
  }
  static std::uint32_t place_of(const Steps& steps) {
    return std::uint32_t{std::bit_cast<std::uint16_t>(steps[1])} |
           std::uint32_t{std::bit_cast<std::uint16_t>(steps[2])} << 16U;
  }

  /// In many small arrays, which find room where a large one does not, and are freed one by one.
  std::vector<std::vector<Steps>> chunks_;
  tbb::concurrent_vector<List> far_;
};

}  // namespace splatray
