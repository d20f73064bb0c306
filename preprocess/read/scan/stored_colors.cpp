#include "preprocess/read/scan/stored_colors.h"

#include <algorithm>
#include <cmath>

#include "engine/base/release.h"
#include "engine/base/srgb.h"

namespace splatray {

void ColorRange::add(double value) {
  if (!std::isfinite(value)) return;
  count_ += value > 0.0 ? 1 : 0;  // points without a colour are black
  most_ = std::max(most_, value);
  whole_ = whole_ && value == std::floor(value);
  high_bytes_ = high_bytes_ && std::floor(value / 256.0) * 256.0 == value;
  if (value <= 1.0) return;
  above_one_ += value > 1.001 ? 1 : 0;  // which rounding makes of 1
  for (std::size_t i = 0; i < FULL.size() && value > FULL[i] + 1.0; ++i) ++above_[i];
}

void ColorRange::add(const std::vector<glm::u16vec3>& colors) {
  for (const glm::u16vec3& color : colors)
    for (int channel = 0; channel < 3; ++channel) add(color[channel]);
}

void ColorRange::add(const ColorRange& more) {
  for (std::size_t i = 0; i < above_.size(); ++i) above_[i] += more.above_[i];
  count_ += more.count_;
  above_one_ += more.above_one_;
  most_ = std::max(most_, more.most_);
  floats_ = floats_ || more.floats_;
  whole_ = whole_ && more.whole_;
  high_bytes_ = high_bytes_ && more.high_bytes_;
}

double ColorRange::full() const {
  constexpr std::uint64_t ONE_OF =
      200;  // more are highlights of a wider range: four times as bright they would all be white
  constexpr std::size_t FEW = 0;  // 8 bits have more than 16 levels wherever something is seen
  const std::uint64_t allowed = count_ / ONE_OF;
  if (most_ <= 1.0 || ((floats_ || !whole_) && above_[FEW] <= allowed)) return 1.0;
  for (std::size_t i = 1; i + 1 < FULL.size(); ++i)
    if (above_[i] <= allowed) return FULL[i];
  return high_bytes_ && !floats_ && most_ <= HIGH_BYTES_FULL ? HIGH_BYTES_FULL : FULL.back();
}

std::uint64_t ColorRange::outliers() const {
  const double most = full();
  const auto* const found = std::lower_bound(FULL.begin(), FULL.end(), most);
  return most == 1.0 ? above_one_ : above_[static_cast<std::size_t>(found - FULL.begin())];
}

std::string color_note(const ColorRange& range) {
  const auto full = static_cast<int>(range.full());
  const bool is_usual = range.is_whole() && (full == 255 || full == 65535 || full == HIGH_BYTES_FULL);
  if (range.is_black() || (is_usual && range.outliers() == 0)) return "";
  std::string said = "colours are taken as of 0 to " + std::to_string(full);
  if (range.outliers() > 0)
    said += "; " + std::to_string(range.outliers()) + " values above it are taken as full";
  return said;
}

std::string store_colors(std::array<std::vector<float>, 3> channels, Points& points) {
  ColorRange range;
  for (const std::vector<float>& channel : channels)
    for (const float value : channel) range.add(static_cast<double>(value));
  const double full = range.full();
  const bool as_stored = range.is_whole() && full > 1.0;
  const double scale = as_stored ? 1.0 : 65535.0 / full;
  points.stored_color.resize(channels[0].size());
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<float>& channel = channels[static_cast<std::size_t>(axis)];
    for (std::size_t i = 0; i < channel.size(); ++i)
      points.stored_color[i][axis] = stored_channel(scale * static_cast<double>(channel[i]));
    release(channel);
  }
  points.stored_color_most = as_stored || range.is_black() ? 0 : 65535;
  return as_stored ? "" : color_note(range);
}

std::string decode_colors(std::vector<glm::vec3>& colors, bool floats) {
  ColorRange range(floats);
  for (const glm::vec3& color : colors)
    for (int channel = 0; channel < 3; ++channel) range.add(static_cast<double>(color[channel]));
  const auto full = static_cast<float>(range.full());
  for (glm::vec3& color : colors)
    for (int channel = 0; channel < 3; ++channel)
      color[channel] = color[channel] > 0.0F ? srgb_to_linear(std::min(color[channel] / full, 1.0F)) : 0.0F;
  return full != 1.0F || range.outliers() > 0 ? color_note(range) : "";
}

}  // namespace splatray
