/// Normals of points that have none.
#pragma once
#include <optional>
#include <span>

#include "preprocess/base/parallel.h"
#include "preprocess/surface/cloud.h"

namespace splatray {

/// Estimates every unknown (zero) normal of the cloud: the direction of least variance of the 16 nearest
/// places and the point itself (Hoppe et al. 1992, "Surface reconstruction from unorganized points",
/// sec. 3.2). Degenerate neighbourhoods: on a straight line the perpendicular nearest `up`; without
/// neighbours `up`. Sides: away from the object's centroid; but a thin object (terrain, a wall: least
/// standard deviation below a third of the second) has all normals on one side, the one nearer `up`.
/// Returns the number of estimated normals. `up` is a unit vector.
std::uint64_t estimate_normals(Cloud& cloud, const glm::dvec3& up, const Stage& stage);

/// The axis across a thin object, the way nearer `up`; nothing where it is not thin.
[[nodiscard]] std::optional<glm::dvec3> sheet_axis(const Cloud& cloud, const glm::dvec3& up);

/// The unit normal of the plane through points (at least one), and degenerate cases, as estimate_normals.
[[nodiscard]] glm::dvec3 plane_normal(std::span<const glm::dvec3> points, const glm::dvec3& up);

}  // namespace splatray
