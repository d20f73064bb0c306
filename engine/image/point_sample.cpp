#include "engine/image/point_sample.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include "engine/base/rank.h"
#include "engine/scene/scene_splat.h"

namespace splatray {
namespace {

constexpr std::size_t SAMPLE_MOST = 1U << 16;
constexpr std::size_t FEW_KEPT = 64;  ///< that say little of what a region holds
constexpr double PART_CELLS = 32.0;   ///< along the longest side of what holds most points
constexpr double PART_OUTSIDE = 0.01;
/// A part with less than 1 / SMALL_PART of the largest one's points is left out.
constexpr std::size_t SMALL_PART = 10;

/// Cells by their number along x, y and z.
using Cell = std::array<std::int32_t, 3>;

/// Numbers the parts of cells that touch.
class Parts {
 public:
  /// The part of each cell, from 0 on.
  explicit Parts(const std::map<Cell, std::size_t>& counts) : counts_(counts) {
    for (const auto& [cell, count] : counts) {
      if (part_.contains(cell)) continue;
      points_.push_back(0);
      collect(cell);
    }
  }

  [[nodiscard]] bool is_main(const Cell& cell) const {
    const std::size_t largest = *std::max_element(points_.begin(), points_.end());
    return SMALL_PART * points_[part_.at(cell)] >= largest;
  }

 private:
  void collect(const Cell& first) {
    const std::size_t number = points_.size() - 1;
    std::vector<Cell> open{first};
    part_[first] = number;
    while (!open.empty()) {
      const Cell cell = open.back();
      open.pop_back();
      points_[number] += counts_.at(cell);
      for (std::int32_t i = 0; i < 27; ++i) {
        const Cell beside{cell[0] + i % 3 - 1, cell[1] + i / 3 % 3 - 1, cell[2] + i / 9 - 1};
        if (counts_.contains(beside) && part_.emplace(beside, number).second) open.push_back(beside);
      }
    }
  }

  const std::map<Cell, std::size_t>& counts_;
  std::map<Cell, std::size_t> part_;
  std::vector<std::size_t> points_;  ///< of each part
};

}  // namespace

namespace {

PointSample every(std::size_t stride, const Scene& scene, const Region& region) {
  PointSample sample;
  const glm::dvec3 rounding(2.0 * scene.root.unit_world);
  const glm::dvec3 low = scene.bounds_min_world - rounding, high = scene.bounds_max_world + rounding;
  const auto add = [&](std::size_t, const SceneSplat& splat) {
    const glm::dvec3 place = splat.center_world();
    if (glm::any(glm::lessThan(place, low)) || glm::any(glm::greaterThan(place, high))) return;
    if (!region.holds(place)) return;
    sample.position.push_back(place);
    sample.normal.push_back(splat.normal());
  };
  for_each_splat(scene, add, stride);
  return sample;
}

}  // namespace

PointSample sample_points(const Scene& scene, const Region& region) {
  for (std::size_t stride = splat_count(scene) / SAMPLE_MOST + 1;; stride = 1) {
    PointSample sample = every(stride, scene, region);
    if (stride == 1 || sample.size() >= FEW_KEPT) return sample;
  }
}

double diagonal_of(const PointSample& sample) {
  if (sample.size() == 0) return 0.0;
  glm::dvec3 low = sample.position.front(), high = low;
  for (const glm::dvec3& point : sample.position) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  return glm::length(high - low);
}

std::array<double, 2> range_along(const std::vector<glm::dvec3>& points, const glm::dvec3& direction,
                                  double outside) {
  if (points.empty()) return {0.0, 0.0};
  std::vector<double> along;
  along.reserve(points.size());
  for (const glm::dvec3& point : points) along.push_back(glm::dot(point, direction));
  return {value_at(along, outside), value_at(along, 1.0 - outside)};
}

glm::dvec3 robust_size(const PointSample& sample, const glm::dmat3& axes) {
  constexpr double OUTSIDE = 0.01;
  glm::dvec3 size(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] = range_along(sample.position, axes[axis], OUTSIDE);
    size[axis] = high - low;
  }
  return size;
}

glm::dvec3 mean_normal(const PointSample& sample) {
  glm::dvec3 mean(0.0);
  for (const glm::dvec3& normal : sample.normal) mean += normal / static_cast<double>(sample.size());
  return mean;
}

double share_of(std::size_t part, std::size_t all) {
  return all > 0 ? static_cast<double>(part) / static_cast<double>(all) : 0.0;
}

PointSample main_parts(const PointSample& sample) {
  glm::dvec3 low(0.0);
  double longest = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 direction(0.0);
    direction[axis] = 1.0;
    const auto [first, last] = range_along(sample.position, direction, PART_OUTSIDE);
    low[axis] = first;
    longest = std::max(longest, last - first);
  }
  const double cells = PART_CELLS / longest;  // in a world unit
  if (!std::isfinite(cells)) return sample;
  const auto cell_of = [&](const glm::dvec3& point) {
    // What lies very far out may have any cell of its own out there.
    const glm::dvec3 cell = glm::clamp(glm::floor((point - low) * cells), -1e6, 1e6);
    return Cell{static_cast<std::int32_t>(cell.x), static_cast<std::int32_t>(cell.y),
                static_cast<std::int32_t>(cell.z)};
  };
  std::map<Cell, std::size_t> counts;
  for (const glm::dvec3& point : sample.position) ++counts[cell_of(point)];
  const Parts parts(counts);
  PointSample kept;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    if (!parts.is_main(cell_of(sample.position[i]))) continue;
    kept.position.push_back(sample.position[i]);
    kept.normal.push_back(sample.normal[i]);
  }
  return kept;
}

}  // namespace splatray
