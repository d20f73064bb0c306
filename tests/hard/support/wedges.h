/// Two square mirrors that meet in a line, exact in float64.
#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "data/oriented_points.h"

namespace splatray::testing {

/// Unit squares that meet in the z axis, open towards +x, mirrors on the sides that face each other; the
/// model `wedge` of data/models.h.
class ExactWedge {
 public:
  explicit ExactWedge(double angle_deg);

  /// What happens to a ray.
  struct Path {
    std::uint32_t bounces = 0;
    double corner_distance = 1e9;  ///< least distance of a meeting with a mirror's plane from the z axis
    double border_distance = 1e9;  ///< the same from the mirrors' other borders
    double least_cosine = 1.0;     ///< of the angles between ray and normal of the mirrors
  };
  [[nodiscard]] Path trace(glm::dvec3 origin, glm::dvec3 dir) const;

  /// A point of mirror 0 or 1; u from the z axis outwards, v along it, both 0..1.
  [[nodiscard]] glm::dvec3 point(std::size_t mirror, double u, double v) const;
  [[nodiscard]] const glm::dvec3& normal(std::size_t mirror) const { return mirrors_[mirror].normal; }

  /// About `count` points on both.
  [[nodiscard]] OrientedPoints sampled(std::uint64_t count, bool even) const;

 private:
  struct Mirror {
    glm::dvec3 outwards;  ///< unit, from the z axis along the mirror
    glm::dvec3 normal;
  };
  double angle_deg_;
  std::array<Mirror, 2> mirrors_;
};

}  // namespace splatray::testing
