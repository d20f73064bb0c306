#include "app/library/cut/floor_levels.h"

#include <algorithm>
#include <cmath>

#include "engine/scene/scene_splat.h"

namespace splatray {
namespace {

constexpr double LEVEL_COSINE = 0.985;                     ///< of 10 degrees
constexpr double HALF_METRES = 0.01, APART_METRES = 0.15;  ///< of a level, and between two
constexpr double LEAST_PART = 0.1;                         ///< of the area of all that is level

struct LevelPart {
  double height, area;
};

}  // namespace

std::vector<double> floor_levels(const Scene& scene, const Region& region, const glm::dvec3& up,
                                 double unit_metres) {
  std::vector<LevelPart> parts;
  double all = 0.0;
  for_each_splat(scene, [&](std::size_t, const SceneSplat& splat) {
    const glm::dvec3 center = splat.center_world();
    if (!region.holds(center) || std::abs(glm::dot(splat.normal(), up)) < LEVEL_COSINE) return;
    const double radius = splat.radius_world();
    parts.push_back({glm::dot(center, up), radius * radius});
    all += radius * radius;
  });
  std::sort(parts.begin(), parts.end(),
            [](const LevelPart& a, const LevelPart& b) { return a.height < b.height; });
  const double half = HALF_METRES / unit_metres, apart = APART_METRES / unit_metres;
  // Windows that end at each part; those that hold the most come first and keep others away.
  struct Window {
    std::size_t first, end;
    double area;
  };
  std::vector<Window> windows;
  double area = 0.0;
  for (std::size_t first = 0, end = 0; end < parts.size();) {
    area += parts[end++].area;
    for (; parts[end - 1].height - parts[first].height > 2.0 * half; ++first) area -= parts[first].area;
    if (area >= LEAST_PART * all) windows.push_back({first, end, area});
  }
  std::stable_sort(windows.begin(), windows.end(),
                   [](const Window& a, const Window& b) { return a.area > b.area; });
  std::vector<double> levels;
  for (const Window& window : windows) {
    double below = 0.0;
    std::size_t middle = window.first;
    while (middle + 1 < window.end && (below += parts[middle].area) < 0.5 * window.area) ++middle;
    const double height = parts[middle].height;
    if (std::none_of(levels.begin(), levels.end(),
                     [&](double other) { return std::abs(other - height) < apart; }))
      levels.push_back(height);
  }
  std::sort(levels.begin(), levels.end());
  return levels;
}

}  // namespace splatray
