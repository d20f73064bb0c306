/// Linear radiance to the 8 bits a screen takes, fast.
#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "shaders/layout.h"

namespace splatray {

/// display_value of app/library/display_image.h, rounded to 8 bits, as a table over the sign, exponent and upper 8 bits of the
/// fraction of a float: at most 1 off.
class DisplayTable {
 public:
  explicit DisplayTable(double exposure_ev);

  /// 0 for negative numbers and NaN.
  [[nodiscard]] std::uint8_t operator()(float radiance) const {
    return values_[std::bit_cast<std::uint32_t>(radiance) >> DROPPED_BITS];
  }
  /// Each pixel as r, g, b, 255.
  [[nodiscard]] std::vector<std::uint8_t> rgba(std::span<const vec4> pixels) const;
  [[nodiscard]] double exposure_ev() const { return exposure_ev_; }

 private:
  static constexpr std::uint32_t DROPPED_BITS = 15;

  double exposure_ev_;
  std::array<std::uint8_t, 1U << (32U - DROPPED_BITS)> values_{};
};

}  // namespace splatray
