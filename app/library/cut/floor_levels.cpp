#include "app/library/cut/floor_levels.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/scene/scene_splat.h"

namespace splatray {
namespace {

constexpr double LEVEL_COSINE = 0.985;                     ///< of 10 degrees
constexpr double HALF_METRES = 0.01, APART_METRES = 0.15;  ///< of a level, and between two
constexpr double LEAST_OF_LEVEL = 0.1;                     ///< of the area of all that is level
/// Least part of the largest floor's area, which does not depend on how many floors there are.
constexpr double LEAST_OF_LARGEST = 0.1;
/// Least part of the area within APART_METRES that faces up: an even slope has HALF_METRES / APART_METRES, 0.07, in a level, a floor with noise of
/// 3 cm a quarter.
constexpr double LEAST_OF_AROUND = 0.2;
/// Least part of all that is level and faces up that lies within APART_METRES of the storeys' floors: of land, which has a level here and
/// there, a quarter does where these are 1.2 m apart.
constexpr double LEAST_OF_STOREYS = 0.5;

struct LevelPart {
  double height, area;
  bool is_up;
};

/// What is level and next to a height.
struct LevelWindow {
  std::size_t first, end;
  double area;
};

/// What is level in the region.
std::vector<LevelPart> level_parts(const Scene& scene, const Region& region, const glm::dvec3& up) {
  std::vector<LevelPart> parts;
  for_each_splat(scene, [&](std::size_t, const SceneSplat& splat) {
    const glm::dvec3 center = splat.center_world();
    const double cosine = glm::dot(splat.normal(), up);
    if (!region.holds(center) || std::abs(cosine) < LEVEL_COSINE) return;
    parts.push_back({glm::dot(center, up), splat.radius_world() * splat.radius_world(), cosine > 0.0});
  });
  return parts;
}

/// Parts by their heights, and their areas between any two.
class LevelParts {
 public:
  explicit LevelParts(std::vector<LevelPart> parts) : parts_(std::move(parts)), below_(1, 0.0) {
    std::sort(parts_.begin(), parts_.end(),
              [](const LevelPart& a, const LevelPart& b) { return a.height < b.height; });
    for (const LevelPart& part : parts_) below_.push_back(below_.back() + part.area);
  }

  /// From low to high, both included.
  [[nodiscard]] double area(double low, double high) const {
    const auto first = std::lower_bound(parts_.begin(), parts_.end(), low,
                                        [](const LevelPart& part, double at) { return part.height < at; });
    const auto end = std::upper_bound(parts_.begin(), parts_.end(), high,
                                      [](double at, const LevelPart& part) { return at < part.height; });
    return below_[static_cast<std::size_t>(end - parts_.begin())] -
           below_[static_cast<std::size_t>(first - parts_.begin())];
  }
  [[nodiscard]] double area() const { return below_.back(); }

  /// Windows of twice `half` that end at each part, the largest first.
  [[nodiscard]] std::vector<LevelWindow> windows(double half) const {
    std::vector<LevelWindow> windows;
    for (std::size_t first = 0, end = 1; end <= parts_.size(); ++end) {
      while (parts_[end - 1].height - parts_[first].height > 2.0 * half) ++first;
      windows.push_back({first, end, below_[end] - below_[first]});
    }
    std::stable_sort(windows.begin(), windows.end(),
                     [](const LevelWindow& a, const LevelWindow& b) { return a.area > b.area; });
    return windows;
  }

  /// The median of a window's heights.
  [[nodiscard]] double height(const LevelWindow& window) const {
    const double middle = 0.5 * (below_[window.first] + below_[window.end]);
    std::size_t at = window.first;
    while (at + 1 < window.end && below_[at + 1] < middle) ++at;
    return parts_[at].height;
  }

 private:
  std::vector<LevelPart> parts_;
  std::vector<double> below_;  ///< sum of the areas of those before each
};

/// Heights of windows that are levels, the lowest first; the largest keep others away. `is_level` returns whether a window is one,
/// nothing where no smaller one can be.
template <typename IsLevel>
std::vector<double> levels_of(const LevelParts& parts, double unit_metres, const IsLevel& is_level) {
  std::vector<double> levels;
  const double apart = APART_METRES / unit_metres;
  for (const LevelWindow& window : parts.windows(HALF_METRES / unit_metres)) {
    const double height = parts.height(window);
    const bool is_near = std::any_of(levels.begin(), levels.end(),
                                     [&](double other) { return std::abs(other - height) < apart; });
    if (is_near) continue;
    const std::optional<bool> found = is_level(window, height);
    if (!found) break;
    if (*found) levels.push_back(height);
  }
  std::sort(levels.begin(), levels.end());
  return levels;
}

}  // namespace

std::vector<double> floor_levels(const Scene& scene, const Region& region, const glm::dvec3& up,
                                 double unit_metres) {
  const LevelParts parts(level_parts(scene, region, up));
  const double least = LEAST_OF_LEVEL * parts.area();
  return levels_of(parts, unit_metres, [least](const LevelWindow& window, double) {
    return window.area >= least ? std::optional(true) : std::nullopt;
  });
}

std::vector<double> storey_floors(const Scene& scene, const Region& region, const glm::dvec3& up,
                                  double unit_metres, double above) {
  std::vector<LevelPart> level = level_parts(scene, region, up);
  const LevelParts all(level);
  std::erase_if(level, [](const LevelPart& part) { return !part.is_up; });
  const LevelParts up_parts(std::move(level));
  const double half = HALF_METRES / unit_metres, apart = APART_METRES / unit_metres;
  double largest = 0.0;
  const auto is_floor = [&](const LevelWindow& window, double height) -> std::optional<bool> {
    if (window.area < LEAST_OF_LARGEST * largest) return {};
    if (window.area < LEAST_OF_AROUND * up_parts.area(height - apart, height + apart) ||
        window.area < 0.5 * all.area(height - half, height + half))
      return false;
    largest = std::max(largest, window.area);
    return true;
  };
  std::vector<double> storeys;
  for (const double height : levels_of(up_parts, unit_metres, is_floor))
    if (storeys.empty() || height >= storeys.back() + above) storeys.push_back(height);
  double of_storeys = 0.0;
  for (const double height : storeys) of_storeys += up_parts.area(height - apart, height + apart);
  return of_storeys >= LEAST_OF_STOREYS * up_parts.area() ? storeys : std::vector<double>();
}

}  // namespace splatray
