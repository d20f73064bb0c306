/// What discs have in a cell of the octree, along the axis of its slab and in its halves.
#pragma once
#include "engine/scene/leaf/disc.h"
#include "engine/scene/leaf/slab.h"
#include "engine/scene/tree.h"

namespace splatray {

/// A cell's halves and the axis of its slab.
struct HalvedCell {
  HalvedCell(const OctreeCell& cell, const glm::dvec3& slab_axis)
      : axis(slab_axis),
        half_size(0.5 * cell.size),
        low(cell.low),
        high(low + 2.0 * half_size),
        lower_high(high),
        upper_low(low) {
    const int across = halved_axis(axis);
    lower_high[across] = upper_low[across] = low[across] + half_size;
  }
  glm::dvec3 axis;
  double half_size;
  glm::dvec3 low, high;
  glm::dvec3 lower_high;  ///< upper corner of the lower half
  glm::dvec3 upper_low;
};

/// From where to where something reaches along the slab's axis, from the cell's centre.
struct Reach {
  double low, high;
};

/// What bounds where the plane n.p = distance reaches in the cube |x|, |y|, |z| <= half_size along the axis a: for any factor,
/// a = factor n + rest, and a.p differs from factor times the distance by what the cube reaches along the rest. Where the
/// bound is tightest one component of the rest is 0 (the dual of the linear program, which has a kink there).
[[gnu::always_inline]] inline Reach plane_in_cube(double factor, const Disc& disc, const glm::dvec3& axis,
                                                  double distance, double half_size) {
  const double rest = std::abs(axis.x - factor * disc.x.normal) + std::abs(axis.y - factor * disc.y.normal) +
                      std::abs(axis.z - factor * disc.z.normal);
  return {factor * distance - half_size * rest, factor * distance + half_size * rest};
}

/// Between what the part of a disc in a cell lies that is larger by `inflation` on each side: the disc's own ends, or those of
/// its plane in the cell. low > high where there is none.
[[gnu::always_inline]] inline Reach reach_in_cell(const Disc& disc, const HalvedCell& cell,
                                                  double inflation) {
  const glm::dvec3& axis = cell.axis;
  const double x = disc.x.center - cell.low.x - cell.half_size;
  const double y = disc.y.center - cell.low.y - cell.half_size;
  const double z = disc.z.center - cell.low.z - cell.half_size;
  const double distance = disc.x.normal * x + disc.y.normal * y + disc.z.normal * z;
  const double half_size = cell.half_size + inflation;
  // Not a number where the axis and the normal have no such component; std::max and min then keep the other.
  const Reach at_x = plane_in_cube(axis.x / disc.x.normal, disc, axis, distance, half_size);
  const Reach at_y = plane_in_cube(axis.y / disc.y.normal, disc, axis, distance, half_size);
  const Reach at_z = plane_in_cube(axis.z / disc.z.normal, disc, axis, distance, half_size);
  const double along_normal = axis.x * disc.x.normal + axis.y * disc.y.normal + axis.z * disc.z.normal;
  const double middle = axis.x * x + axis.y * y + axis.z * z;
  const double across =
      disc.radius * std::sqrt(std::max(glm::dot(axis, axis) - along_normal * along_normal, 0.0));
  const double low = std::max(std::max(std::max(middle - across, at_x.low), at_y.low), at_z.low);
  const double high = std::min(std::min(std::min(middle + across, at_x.high), at_y.high), at_z.high);
  return {low, high};
}

}  // namespace splatray
