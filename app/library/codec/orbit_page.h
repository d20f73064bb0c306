/// A page of a pre-rendered orbit: one file of HTML that needs nothing else, in which one turns, zooms and measures.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "engine/scene/camera.h"

namespace splatray {

/// One picture of the orbit.
struct OrbitPicture {
  Camera camera;
  std::vector<unsigned char> jpeg;
  /// PNG of the distances from the eye: 256 red + green of DEPTH_STEPS steps between `near` and `far`; 0 = nothing there.
  std::vector<unsigned char> depth_png;
};
inline constexpr std::uint32_t DEPTH_STEPS = 65535;

struct OrbitPage {
  std::string title;
  std::uint32_t width = 0, height = 0;  ///< of the pictures, pixels
  std::uint32_t depth_step = 1;  ///< edge of the squares of pixels that have a depth each, of their middle
  double near = 0.0, far = 1.0;  ///< world units
  double unit_metres = 0.0;      ///< of a world unit; 0 = unknown
  std::uint32_t columns = 0;     ///< pictures of a full turn, from the same height one after the other
  std::vector<OrbitPicture> pictures;  ///< from the lowest height to the highest
};

/// The page's text, UTF-8.
[[nodiscard]] std::string orbit_html(const OrbitPage& page);

}  // namespace splatray
