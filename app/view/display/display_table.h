/// Linear radiance to the 8 bits a screen takes, fast.
#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "app/library/display_image.h"
#include "shaders/display/display_layout.h"

namespace splatray {

/// display_value of app/library/display_image.h, rounded to 8 bits, as a table over the sign, exponent and upper 8 bits of the
/// fraction of a float: at most 1 off. Tone curves that mix channels are worked out for each pixel, before the table.
class DisplayTable {
 public:
  explicit DisplayTable(const Display& display);

  /// 0 for negative numbers and NaN.
  [[nodiscard]] std::uint8_t operator()(float radiance) const {
    return values_[std::bit_cast<std::uint32_t>(radiance) >> DROPPED_BITS];
  }
  /// Each pixel as r, g, b, 255.
  [[nodiscard]] std::vector<std::uint8_t> rgba(std::span<const vec4> pixels) const;
  [[nodiscard]] const Display& display() const { return display_; }
  /// The table, by the upper bits of a float.
  [[nodiscard]] std::span<const std::uint8_t> values() const { return values_; }

 private:
  static constexpr std::uint32_t DROPPED_BITS = DISPLAY_DROPPED_BITS;

  Display display_;
  bool mixes_;  ///< the tone curve mixes channels
  std::array<std::uint8_t, 1U << (32U - DROPPED_BITS)> values_{};
};

}  // namespace splatray
