/// Colours as text and fields of numbers give them.
#pragma once
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "preprocess/points.h"

namespace splatray {

/// A channel of 8 or 16 bits; what is no number is 0.
[[nodiscard]] inline std::uint16_t stored_channel(double value) {
  return value > 0.0 ? static_cast<std::uint16_t>(std::min(value, 65535.0) + 0.5) : std::uint16_t{0};
}

/// Fills `stored_color` from its three channels, which are freed, and judges from all values what they are: whole numbers
/// keep their value, for `stored_color_most` to be judged later; fractions, and values that are all 0 or 1, are of 0 to 1,
/// or to 255, or to 65535, and become 16 bits. What was taken for granted; empty = nothing.
[[nodiscard]] std::string store_colors(std::array<std::vector<float>, 3> channels, Points& points);

}  // namespace splatray
