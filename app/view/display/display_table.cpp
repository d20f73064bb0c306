#include "app/view/display/display_table.h"

#include <cmath>
#include <limits>

#include "app/library/display_image.h"

namespace splatray {

DisplayTable::DisplayTable(const Display& display)
    : display_(display), mixes_(display.tone == Tone::neutral || display.tone == Tone::agx) {
  const Display channels = mixes_ ? Display(0.0, Tone::none) : display;
  constexpr std::uint32_t MIDDLE = 1U << (DROPPED_BITS - 1U);
  for (std::uint32_t i = 0; i < values_.size(); ++i) {
    float radiance = std::bit_cast<float>(i << DROPPED_BITS | MIDDLE);
    const bool infinite = std::bit_cast<float>(i << DROPPED_BITS) == std::numeric_limits<float>::infinity();
    if (infinite) radiance = std::numeric_limits<float>::max();
    values_[i] = static_cast<std::uint8_t>(std::lround(255.0F * display_value(vec3(radiance), channels).x));
  }
}

std::vector<std::uint8_t> DisplayTable::rgba(std::span<const vec4> pixels) const {
  std::vector<std::uint8_t> bytes(4 * pixels.size());
  std::uint8_t* out = bytes.data();
  for (const vec4& radiance : pixels) {
    const vec3 pixel = mixes_ ? toned(vec3(radiance), display_) : vec3(radiance);
    out[0] = (*this)(pixel.x);
    out[1] = (*this)(pixel.y);
    out[2] = (*this)(pixel.z);
    out[3] = 255;
    out += 4;
  }
  return bytes;
}

}  // namespace splatray
