#include "data/scanner.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>

namespace splatray {
namespace {

constexpr double LEAST_COSINE = 0.15;

/// Row and column of the scanner's grid of directions.
glm::ivec2 cell_of(glm::dvec3 away, double step_rad) {
  const double elevation = std::atan2(away.y, std::hypot(away.x, away.z));
  return glm::floor(glm::dvec2(elevation, std::atan2(away.z, away.x)) / step_rad);
}

glm::dvec3 direction(glm::ivec2 cell, double step_rad) {
  const glm::dvec2 angles = (glm::dvec2(cell) + 0.5) * step_rad;
  return {std::cos(angles.x) * std::cos(angles.y), std::sin(angles.x),
          std::cos(angles.x) * std::sin(angles.y)};
}

/// The nearest of the surface's points in each direction that meets one, by its index, in the order of rows and columns.
std::vector<std::size_t> nearest_points(const OrientedPoints& surface, const Scanner& scanner) {
  struct Seen {
    glm::ivec2 cell;
    double range;
    std::size_t index;
  };
  std::vector<Seen> all(surface.position.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const glm::dvec3 away = surface.position[i] - scanner.place;
    all[i] = {cell_of(away, scanner.step_rad), glm::length(away), i};
  }
  const auto key = [](const Seen& seen) {
    return std::tuple(seen.cell.x, seen.cell.y, seen.range, seen.index);
  };
  std::sort(all.begin(), all.end(), [&](const Seen& a, const Seen& b) { return key(a) < key(b); });
  const auto end =
      std::unique(all.begin(), all.end(), [](const Seen& a, const Seen& b) { return a.cell == b.cell; });
  std::vector<std::size_t> nearest;
  for (auto seen = all.begin(); seen != end; ++seen) nearest.push_back(seen->index);
  return nearest;
}

}  // namespace

OrientedPoints scan(const OrientedPoints& surface, const Scanner& scanner) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, scanner.noise_m);
  OrientedPoints seen;
  for (const std::size_t i : nearest_points(surface, scanner)) {
    const glm::dvec3 ray =
        direction(cell_of(surface.position[i] - scanner.place, scanner.step_rad), scanner.step_rad);
    const double cosine = -glm::dot(surface.normal[i], ray);
    if (cosine < LEAST_COSINE) continue;
    const double range = -glm::dot(surface.normal[i], surface.position[i] - scanner.place) / cosine;
    seen.position.push_back(scanner.place + ray * (range + noise(random)));
    seen.normal.push_back(surface.normal[i]);
    if (!surface.color.empty()) seen.color.push_back(surface.color[i]);
  }
  return seen;
}

}  // namespace splatray
