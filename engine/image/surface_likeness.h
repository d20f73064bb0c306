/// How much of one pixel's surface another one shows.
#pragma once
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/image/image.h"
#include "engine/image/pixel_rows.h"

namespace splatray {

/// e^x for x <= 0, to 2e-5 of it, in loops that are vectorised; e^-87 below -87 and of NaN, 1 above 0.
[[nodiscard]] inline float decay(float x) {
  const float least = x > -87.0F ? x : -87.0F;
  const float powers = (least < 0.0F ? least : 0.0F) * 1.442695041F;  // of two
  const int whole = static_cast<int>(powers);
  const float f = powers - static_cast<float>(whole);  // -1 to 0: the first terms of 2^f
  const float part =
      1.0F + f * (0.693147181F +
                  f * (0.240226507F +
                       f * (0.0555041087F + f * (0.00961812911F + f * (0.00133335581F + f * 1.54035e-4F)))));
  return part * std::bit_cast<float>((whole + 127) << 23);
}

/// The surfaces of an image with aov, a list for each number. `base`: base colours of its pixels, 0 to 1.
class SurfaceLikeness {
 public:
  SurfaceLikeness(const Image& image, std::span<const vec4> base);

  [[nodiscard]] bool is_surface(std::size_t pixel) const { return object_[pixel] != NO_OBJECT; }
  /// Whether any of `count` pixels from `first` on shows a surface.
  [[nodiscard]] bool any_surface(std::size_t first, std::size_t count) const;
  /// 0 to 1 for each pixel with its neighbour, from like[taps.first] on: of the same object, by the angle between normals, by the
  /// step of depth beyond the surface's own slope and by the base colours' distance. 1 of a pixel with itself. Without meaning where the pixel shows no surface.
  void find(const Taps& taps, Piece& like) const;

 private:
  std::vector<std::uint32_t> object_;
  std::vector<float> normal_x_, normal_y_, normal_z_, depth_, base_r_, base_g_, base_b_;
  /// Least change of depth towards a neighbour: at edges that of the pixel's own surface.
  std::vector<float> slope_x_, slope_y_;
};

}  // namespace splatray
