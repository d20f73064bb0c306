#include "engine/image/point_sample.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>

#include "engine/base/rank.h"
#include "engine/image/view.h"
#include "engine/scene/scene_splat.h"

namespace splatray {
namespace {

constexpr std::size_t SAMPLE_MOST = 1U << 16;
constexpr std::size_t FEW_KEPT = 64;  ///< that say little of what a region holds
constexpr double PART_CELLS = 32.0;   ///< along the longest side of what holds most points
constexpr double PART_OUTSIDE = 0.01;
/// A part with less than 1 / SMALL_PART of the largest one's points is left out.
constexpr std::size_t SMALL_PART = 10;
constexpr double DEGREE = std::numbers::pi / 180.0;  ///< radians
constexpr double CAMERA_DEG = 50.0, NARROW_DEG = 8.0, CAMERA_SHARE = 0.98;
constexpr std::size_t FIELD_CELLS = 64;  ///< across the field, each way
constexpr double BEHIND = 1.1, BEHIND_SHARE = 0.3, ALONG_Z_DEG = 20.0;

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

/// The mean direction from a place to the points.
glm::dvec3 ahead_of(const PointSample& sample, const glm::dvec3& place) {
  glm::dvec3 ahead(0.0);
  for (const glm::dvec3& point : sample.position)
    if (point != place) ahead += glm::normalize(point - place);
  return glm::length(ahead) > 0.0 ? glm::normalize(ahead) : glm::dvec3(0.0, 0.0, 1.0);
}

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

bool is_flat(const PointSample& sample, const glm::dmat3& axes) {
  constexpr double FLAT = 0.3;
  const glm::dvec3 size = robust_size(sample, axes);
  return size.y < FLAT * std::min(size.x, size.z);
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

bool is_in_field_of(const PointSample& sample, const glm::dvec3& place) {
  const glm::dvec3 ahead = ahead_of(sample, place);
  std::size_t wide = 0, narrow = 0;
  for (const glm::dvec3& point : sample.position) {
    const double cosine = glm::dot(point - place, ahead) / glm::distance(point, place);
    wide += cosine > std::cos(CAMERA_DEG * DEGREE) ? 1 : 0;
    narrow += cosine > std::cos(NARROW_DEG * DEGREE) ? 1 : 0;
  }
  return share_of(wide, sample.size()) >= CAMERA_SHARE && share_of(narrow, sample.size()) <= CAMERA_SHARE;
}

bool is_seen_from(const PointSample& sample, const glm::dvec3& place) {
  if (!is_in_field_of(sample, place)) return false;
  const glm::dvec3 ahead = ahead_of(sample, place);
  const glm::dmat3 axes = upright_axes(ahead);
  std::array<double, FIELD_CELLS * FIELD_CELLS> nearest;
  nearest.fill(std::numeric_limits<double>::infinity());
  const auto cell_of = [&](const glm::dvec3& point) {
    const glm::dvec3 q = glm::transpose(axes) * (point - place);  // y is ahead
    const double half = 0.5 * FIELD_CELLS, scale = half / std::tan(CAMERA_DEG * DEGREE);
    const auto along = [&](double across) {
      return static_cast<std::size_t>(std::clamp(half + scale * across / q.y, 0.0, FIELD_CELLS - 1.0));
    };
    return along(q.x) * FIELD_CELLS + along(q.z);
  };
  std::size_t behind = 0;
  for (const glm::dvec3& point : sample.position) {
    const double distance = glm::distance(point, place), cosine = glm::dot(point - place, ahead) / distance;
    if (!(cosine > std::cos(CAMERA_DEG * DEGREE))) continue;
    double& first = nearest[cell_of(point)];
    first = std::min(first, distance);
  }
  for (const glm::dvec3& point : sample.position)
    if (glm::dot(point - place, ahead) > 0.0 &&
        glm::distance(point, place) > BEHIND * nearest[cell_of(point)])
      ++behind;
  return share_of(behind, sample.size()) < BEHIND_SHARE;
}

bool is_seen_along_z(const PointSample& sample, const glm::dvec3& up) {
  const bool terrain = up == glm::dvec3(0.0, 0.0, 1.0) && is_flat(sample, upright_axes(up));
  const glm::dvec3 ahead = ahead_of(sample, glm::dvec3(0.0));
  return !terrain && ahead.z > std::cos(ALONG_Z_DEG * DEGREE) && is_seen_from(sample, glm::dvec3(0.0));
}

}  // namespace splatray
