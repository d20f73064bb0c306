/// Colours that stand for numbers.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>

namespace splatray {

/// Display-encoded (sRGB) rgb, 0..1, of a share 0..1: dark blue over green to yellow, each step equally visible.
/// Clamped outside.
[[nodiscard]] glm::vec3 heat_color(float share);

/// The same of a height: blue-green over green and ochre to rose, soft and of middle brightness, so that light and shade on it
/// are seen as they are on land.
[[nodiscard]] glm::vec3 land_color(float share);

/// The same of a deviation, -1..1: blue over near white at 0 to red, as dark on either side.
[[nodiscard]] glm::vec3 signed_color(float deviation);

/// A colour of its own for each number, display-encoded; consecutive ones differ in hue and lightness.
[[nodiscard]] glm::vec3 number_color(std::uint32_t number);

}  // namespace splatray
