#include "engine/image/framing/broad_side.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "engine/image/view.h"

namespace splatray {
namespace {

constexpr int HALF = 12;  ///< of a full turn, in steps
constexpr double TURN_DEG = 180.0 / HALF;
/// Shares of the widest silhouette. Sixteen models and scans have 0.76 to 1 from the usual side, a cube seen square to a face 0.71, a guitar near
/// its edge 0.70, a plate 30 degrees from square 0.87.
constexpr double NARROW = 0.72, BROAD = 0.85;
constexpr double ONE_SIDED = 0.3;  ///< length of the mean normal of what was seen from one side
/// Along the longest side of what holds 98 % of the points; fewer of few points, so that a side has several in each.
constexpr double MOST_CELLS = 128.0, CELLS_PER_ROOT = 0.5;
constexpr double ENDS = 0.01;
constexpr std::size_t FEWEST = 100;  ///< points: silhouettes of fewer differ by chance

/// How many cells of a picture across `right` and `up` have points.
std::size_t silhouette(const PointSample& sample, const glm::dvec3& right, const glm::dvec3& up,
                       double cell) {
  constexpr int SIDE =
      2 * static_cast<int>(MOST_CELLS);  // turned about the vertical a box is longer by 1.41 at most
  const auto [left, most_right] = range_along(sample.position, right, ENDS);
  const auto [low, high] = range_along(sample.position, up, ENDS);
  std::vector<bool> met(static_cast<std::size_t>(SIDE * SIDE), false);
  for (const glm::dvec3& point : sample.position) {
    const double x = glm::dot(point, right), y = glm::dot(point, up);
    if (x < left || x > most_right || y < low || y > high) continue;
    const int column = std::min(static_cast<int>((x - left) / cell), SIDE - 1),
              row = std::min(static_cast<int>((y - low) / cell), SIDE - 1);
    met[static_cast<std::size_t>(row * SIDE + column)] = true;
  }
  return static_cast<std::size_t>(std::count(met.begin(), met.end(), true));
}

}  // namespace

double broad_azimuth_deg(const PointSample& sample, const glm::dmat3& axes) {
  const glm::dvec3 size = robust_size(sample, axes);
  const double cells = std::min(MOST_CELLS, CELLS_PER_ROOT * std::sqrt(static_cast<double>(sample.size())));
  const double cell = std::max({size.x, size.y, size.z}) / cells;
  if (sample.size() < FEWEST || !(cell > 0.0)) return DEFAULT_AZIMUTH_DEG;
  const auto towards = [&](int turn) {  // the eye
    const double azimuth = (DEFAULT_AZIMUTH_DEG + turn * TURN_DEG) * std::numbers::pi / 180.0;
    return std::cos(azimuth) * axes[2] + std::sin(azimuth) * axes[0];
  };
  std::array<std::size_t, HALF> seen{};  // from behind the same
  for (int turn = 0; turn < HALF; ++turn)
    seen[static_cast<std::size_t>(turn)] =
        silhouette(sample, glm::cross(axes[1], towards(turn)), axes[1], cell);
  const auto widest = static_cast<double>(*std::max_element(seen.begin(), seen.end()));
  if (static_cast<double>(seen[0]) >= NARROW * widest) return DEFAULT_AZIMUTH_DEG;
  glm::dvec3 facing = mean_normal(sample);
  facing -= glm::dot(facing, axes[1]) * axes[1];
  const bool one_sided = glm::length(facing) > ONE_SIDED;
  for (int turns = 1; turns <= HALF; ++turns)
    for (const int turn : {turns, -turns}) {
      const bool faces = !one_sided || glm::dot(facing, towards(turn)) > 0.0;
      if (faces && static_cast<double>(seen[static_cast<std::size_t>(turn + HALF) % HALF]) >= BROAD * widest)
        return DEFAULT_AZIMUTH_DEG + turn * TURN_DEG;
    }
  return DEFAULT_AZIMUTH_DEG;
}

}  // namespace splatray
