/// The light in which pictures of different methods are compared: one fixed Phong light, so that nothing but geometry
/// distinguishes them.
#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "engine/image/view.h"

namespace splatray::testing {

/// Unit normal of what a pixel (column, row) shows, world space, turned against the ray; nothing where it shows no surface.
using NormalAt = std::function<std::optional<glm::dvec3>(std::uint32_t x, std::uint32_t y)>;

/// The picture as sRGB, 0..1, rounded to 8 bits, rows from the top: white light from 35 degrees left of the eye and 45
/// above, diffuse 0.7, ambient 0.1, Phong highlight 0.2 of exponent 40, in float64; 0.18 behind it all.
[[nodiscard]] std::vector<glm::vec3> shaded_picture(const View& view, const NormalAt& normal_at);

/// Peak signal-to-noise ratio of two pictures, all channels, peak 1; +inf for equal ones.
[[nodiscard]] double psnr_db(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b);

/// sRGB, 0..1, rounded to 8 bits, of linear values, which are clipped to 0..1.
[[nodiscard]] glm::vec3 srgb_8_bit(const glm::dvec3& linear);

}  // namespace splatray::testing
