#include "preprocess/scan/occupancy.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <span>

#include "preprocess/base/select.h"

namespace splatray {
namespace {

constexpr double REACHES = 2.5;

}  // namespace

Occupancy::Occupancy(const Cloud& cloud, double edge, double along) : low_(INFINITY) {
  glm::dvec3 high(-INFINITY);
  for (const glm::vec3& coord : cloud.coord) {
    low_ = glm::min(low_, glm::dvec3(coord));
    high = glm::max(high, glm::dvec3(coord));
  }
  const glm::dvec3 extent = high - low_;
  edge_ = std::max(edge, std::max({extent.x, extent.y, extent.z, 1e-6}) / along);
  size_ = glm::ivec3(extent / edge_) + 1;
  const auto cells = static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y) *
                     static_cast<std::size_t>(size_.z);
  bits_.resize(cells / 64 + 1);
  for (const glm::vec3& coord : cloud.coord) {
    const glm::ivec3 cell((glm::dvec3(coord) - low_) / edge_);
    const std::size_t number = (static_cast<std::size_t>(cell.z) * static_cast<std::size_t>(size_.y) +
                                static_cast<std::size_t>(cell.y)) *
                                   static_cast<std::size_t>(size_.x) +
                               static_cast<std::size_t>(cell.x);
    bits_[number / 64] |= std::uint64_t{1} << number % 64;
  }
}

std::vector<glm::dvec3> Occupancy::free_places(std::size_t most) const {
  const auto cells = static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y) *
                     static_cast<std::size_t>(size_.z);
  std::size_t full = 0;
  for (const std::uint64_t bits : bits_) full += static_cast<std::size_t>(std::popcount(bits));
  const std::size_t stride = (cells - full) / std::max<std::size_t>(most, 1) + 1;
  std::vector<glm::dvec3> places;
  std::size_t free = 0;
  for (int z = 0; z < size_.z; ++z)
    for (int y = 0; y < size_.y; ++y)
      for (int x = 0; x < size_.x; ++x) {
        const glm::ivec3 cell(x, y, z);
        if (!filled(cell) && free++ % stride == 0) places.push_back(low_ + edge_ * (glm::dvec3(cell) + 0.5));
      }
  return places;
}

/// Walks from cell to cell (Amanatides, Woo 1987).
std::optional<double> Occupancy::free_path(const glm::dvec3& origin, const glm::dvec3& dir) const {
  const glm::dvec3 start = (origin - low_) / edge_;
  glm::ivec3 cell(glm::floor(start));
  glm::ivec3 step;
  glm::dvec3 next, wait;
  for (int axis = 0; axis < 3; ++axis) {
    step[axis] = dir[axis] < 0.0 ? -1 : 1;
    wait[axis] = dir[axis] != 0.0 ? std::abs(1.0 / dir[axis]) : INFINITY;
    const double to_face = dir[axis] < 0.0 ? start[axis] - cell[axis] : cell[axis] + 1.0 - start[axis];
    next[axis] = dir[axis] != 0.0 ? to_face * wait[axis] : INFINITY;
  }
  for (double t = 0.0;;) {
    for (int axis = 0; axis < 3; ++axis)
      if (cell[axis] < 0 || cell[axis] >= size_[axis]) return {};
    if (filled(cell)) return t * edge_;
    const int axis = next.x <= next.y && next.x <= next.z ? 0 : next.y <= next.z ? 1 : 2;
    t = next[axis];
    next[axis] += wait[axis];
    cell[axis] += step[axis];
  }
}

double cell_edge(const Survey& survey) {
  if (survey.reach.empty()) return 0.0;
  std::vector<float> ranked = survey.reach;
  const std::size_t sparse = ranked.size() * 9 / 10;
  select_nth(std::span(ranked), sparse, std::identity());
  return REACHES * ranked[sparse];
}

}  // namespace splatray
