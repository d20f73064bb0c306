/// An even choice of a scene's splats, from which its shape is known and its picture framed.
#pragma once
#include <array>
#include <vector>

#include "engine/image/region.h"
#include "engine/scene/scene.h"

namespace splatray {

struct PointSample {
  std::vector<glm::dvec3> position;  ///< centres, world space
  std::vector<glm::dvec3> normal;    ///< unit, beside them

  [[nodiscard]] std::size_t size() const { return position.size(); }
};

/// Every n-th splat of the scene's order that the region holds, without those beyond the scene's bounds: its ground's. At most
/// 2^16, but all of a region that holds few of these.
[[nodiscard]] PointSample sample_points(const Scene& scene, const Region& region = {});

/// Without what hangs together with less than a tenth of the largest part: strays, what was seen through a window. Points hang
/// together that lie in cells which touch, 1/32 of what holds 98 % of the points along its longest side.
[[nodiscard]] PointSample main_parts(const PointSample& sample);

/// Length of the diagonal of the points' bounding box; 0 without points.
[[nodiscard]] double diagonal_of(const PointSample& sample);

/// The values along a unit direction that leave `outside` of all points out at each end, 0..0.5; 0, 0 without points.
[[nodiscard]] std::array<double, 2> range_along(const std::vector<glm::dvec3>& points,
                                                const glm::dvec3& direction, double outside);

/// The size along each of three axes, without a hundredth of the points at each end.
[[nodiscard]] glm::dvec3 robust_size(const PointSample& sample, const glm::dmat3& axes);
/// Whether points are less than 0.3 times as high, along the second of three axes, as wide (robust_size).
[[nodiscard]] bool is_flat(const PointSample& sample, const glm::dmat3& axes);
/// Whether 98 % of the points lie within 50 degrees of one direction from a place, as in a camera's field, but not within 8.
[[nodiscard]] bool is_in_field_of(const PointSample& sample, const glm::dvec3& place);
/// Whether that holds and seven tenths have no other 10 % closer before them: four depth cameras' points have it for 0.19 to 0.26, sweeps and things for 0.32 and more.
[[nodiscard]] bool is_seen_from(const PointSample& sample, const glm::dvec3& place);

/// Whether all was seen from the origin along z: the frame of a depth camera. What lies flat where `up`, its format's, is z is none:
/// terrain in local coordinates, high above their zero.
[[nodiscard]] bool is_seen_along_z(const PointSample& sample, const glm::dvec3& up);

/// The mean of the normals; shorter than 1 the more they differ.
[[nodiscard]] glm::dvec3 mean_normal(const PointSample& sample);
/// One number over another; 0 over 0.
[[nodiscard]] double share_of(std::size_t part, std::size_t all);

}  // namespace splatray
