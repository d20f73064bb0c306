#include "preprocess/tree/root.h"

#include <algorithm>
#include <cmath>

namespace splatray {
namespace {

/// Packing rounds radii up by at most 2^-9 of r^2 and turns normals by at most 5e-5.
constexpr double RADIUS_SLACK = 1.0 + 1.0 / 512.0;
constexpr double NORMAL_SLACK = 1e-4;
/// Packing moves centres by half a unit and makes no radius smaller than sqrt(2) units.
constexpr double LATTICE_SLACK = 3.0;
/// Along an axis on which all discs take up less of the root than THIN_ROOT, their middle lies at a third of it: no plane between
/// cells is nearer there than a third of its cells, where in the middle a sheet would be listed on both sides of all of them.
constexpr double THIN_ROOT = 1.0 / 64.0;
constexpr double BETWEEN_PLANES = 1.0 / 3.0;

}  // namespace

void DiscBounds::add(const glm::dvec3& center, const glm::dvec3& normal, double radius) {
  const glm::dvec3 across = glm::sqrt(glm::max(1.0 - normal * normal, 0.0));
  const glm::dvec3 half = radius * RADIUS_SLACK * glm::min(across + NORMAL_SLACK, 1.0);
  low = glm::min(low, center - half);
  high = glm::max(high, center + half);
}

void DiscBounds::add(const DiscBounds& other) {
  low = glm::min(low, other.low);
  high = glm::max(high, other.high);
}

RootTransform fit_root(const DiscBounds& bounds) {
  constexpr double root_size = 1U << LATTICE_BITS;
  const glm::dvec3 extent = bounds.high - bounds.low;
  const glm::dvec3 largest = glm::max(glm::abs(bounds.low), glm::abs(bounds.high));
  const double unit =
      std::max({extent.x, extent.y, extent.z}) / (root_size - 2.0 * (ROOT_MARGIN + LATTICE_SLACK));
  RootTransform root;
  root.unit_world = std::max(unit, std::max({largest.x, largest.y, largest.z}) * 0x1p-45);
  const double size_world = root_size * root.unit_world;
  for (int axis = 0; axis < 3; ++axis) {
    const double place = extent[axis] < THIN_ROOT * size_world ? BETWEEN_PLANES : 0.5;
    root.origin_world[axis] = 0.5 * (bounds.low[axis] + bounds.high[axis]) - place * size_world;
  }
  return root;
}

}  // namespace splatray
