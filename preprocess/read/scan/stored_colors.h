/// Colours as text and fields of numbers give them.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "preprocess/points.h"

namespace splatray {

/// A channel of 8 or 16 bits; what is no number is 0.
[[nodiscard]] inline std::uint16_t stored_channel(double value) {
  return value > 0.0 ? static_cast<std::uint16_t>(std::min(value, 65535.0) + 0.5) : std::uint16_t{0};
}

/// Full colour of 8 bits that stand in the high byte of 16.
inline constexpr double HIGH_BYTES_FULL = 0xFF00;

/// What full colour is, judged from all channels' values: the one rule of all formats that do not say it by their type.
class ColorRange {
 public:
  /// `floats`: the values are stored as such, which colours of 8 bits hardly are.
  explicit ColorRange(bool floats = false) : floats_(floats) {}

  void add(double value);  ///< what is not finite says nothing
  void add(const std::vector<glm::u16vec3>& colors);
  void add(const ColorRange& more);  ///< what another has seen

  /// 1, 255, 1023, 4095 or 65535: the least of these that all values above 0 but one in 200 are at most, or one above. Fractions and
  /// floats of which all but as many are at most 16 are of 0 to 1, as are values that are all 0 or 1. HIGH_BYTES_FULL in place of 65535
  /// where all values are multiples of 256 and no floats: some programs store 8 bits in the high byte of 16, and not times 257.
  [[nodiscard]] double full() const;
  [[nodiscard]] bool is_whole() const { return whole_; }          ///< all values are whole numbers
  [[nodiscard]] bool is_black() const { return !(most_ > 0.0); }  ///< no value is above 0
  /// Values above full() and one more, which are taken as full.
  [[nodiscard]] std::uint64_t outliers() const;

 private:
  static constexpr std::array<double, 5> FULL{16.0, 255.0, 1023.0, 4095.0, 65535.0};

  std::array<std::uint64_t, FULL.size()> above_{};  ///< values that are more than one above each
  std::uint64_t count_ = 0;                         ///< values above 0
  std::uint64_t above_one_ = 0;
  double most_ = 0.0;
  bool floats_ = false;
  bool whole_ = true;
  bool high_bytes_ = true;  ///< all values are multiples of 256
};

/// What was taken for granted about colours of this range, "" where nothing: 8 and 16 bits without outliers go without
/// saying.
[[nodiscard]] std::string color_note(const ColorRange& range);

/// Fills `stored_color` from its three channels, which are freed, and judges from all values what they are: whole numbers
/// keep their value, for `stored_color_most` to be judged later from all files; others become 16 bits. What was taken for
/// granted; empty = nothing.
[[nodiscard]] std::string store_colors(std::array<std::vector<float>, 3> channels, Points& points);

/// Display-encoded colours of any one scale to linear rgb, 0..1; what is no number becomes 0. `floats` as of ColorRange. What
/// was taken for granted; empty = nothing.
[[nodiscard]] std::string decode_colors(std::vector<glm::vec3>& colors, bool floats = false);

}  // namespace splatray
