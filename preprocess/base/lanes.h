/// Eight floats at a time, as the compiler's vectors: AVX2 takes them whole (vector_clones.h), every other CPU in parts.
#pragma once
#include <cstdint>
#include <cstring>

namespace splatray {

inline constexpr std::size_t LANES = 8;
using Lanes = float __attribute__((vector_size(4 * LANES)));
using LaneInts = std::int32_t __attribute__((vector_size(4 * LANES)));

// All of these are macros in all but name: passed by value, such vectors would be in memory without AVX.

/// The LANES numbers from `from` on, which needs no alignment.
[[gnu::always_inline]] inline void load_lanes(const float* from, Lanes& lanes) {
  std::memcpy(&lanes, from, sizeof lanes);
}

[[gnu::always_inline]] inline void store_lanes(const Lanes& lanes, float* to) {
  std::memcpy(to, &lanes, sizeof lanes);
}

/// Their sum, by pairs; the order is the same on every CPU.
[[gnu::always_inline]] inline float sum_lanes(const Lanes& v) {
  return ((v[0] + v[4]) + (v[1] + v[5])) + ((v[2] + v[6]) + (v[3] + v[7]));
}

}  // namespace splatray
