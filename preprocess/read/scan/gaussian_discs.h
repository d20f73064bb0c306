/// Captures of 3D Gaussians (Kerbl et al. 2023, "3D Gaussian Splatting for Real-Time Radiance Field Rendering") as elliptic discs.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>

#include "preprocess/points.h"

namespace splatray {

/// One Gaussian as captures store it, decoded.
struct Gaussian {
  glm::dvec3 center_world;
  glm::dvec3 deviation_world;  ///< standard deviations along its axes, >= 0
  glm::dquat axes;             ///< turns x, y and z to its axes; of any length but 0
  double opacity;              ///< in its centre, 0..1
  glm::dvec3 color;            ///< display-encoded, seen from all sides on average; 0..1 is shown
};

/// Takes Gaussians as flat discs: across the axis of the least deviation, out to where the opacity is a half, so that what hides most
/// of what lies behind is opaque and all else is not there. Left out are those less opaque than a half in their centre, those whose radius
/// is more than the diagonal of the box of all centres, and those whose numbers are no Gaussian. Discs hardly longer than wide are
/// round, of the same area.
class GaussianDiscs {
 public:
  void reserve(std::size_t count);
  void add(const Gaussian& one);
  /// Discs with normals that may be turned either way, radii and ellipses; up is -y, as the cameras of such captures mostly have it.
  [[nodiscard]] Points take();
  /// What became of them, a sentence; behind take().
  [[nodiscard]] std::string note() const;

 private:
  Points points_;
  std::uint64_t discs_ = 0;
  std::uint64_t vast_ = 0;
  std::uint64_t faint_ = 0;
  std::uint64_t invalid_ = 0;
};

}  // namespace splatray
