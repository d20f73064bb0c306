#include "preprocess/surface/smooth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "preprocess/base/select.h"
#include "preprocess/surface/neighbours.h"

namespace splatray {
namespace {

constexpr std::size_t MOST = 64;     // neighbours
constexpr double LEAST_WEIGHED = 6;  // of them, that have any weight
constexpr float REACHES = 2.5F;      // of the distance to the 8th place: about 4 spacings
constexpr int REWEIGHTINGS = 2;
constexpr double WIDE = 2.0;  // of the heights' standard deviation: what is farther off has little weight

/// A neighbour of the point that is moved.
struct Near {
  glm::dvec3 offset, normal;
  double weight;
};

struct Plane {
  glm::dvec3 mean{0.0}, normal{0.0};
  double weight = 0.0, deviation = 0.0;  ///< of the heights over it
};

Plane fit_plane(std::span<const Near> around, const std::array<double, MOST + 1>& weights) {
  Plane plane;
  for (std::size_t j = 0; j < around.size(); ++j) {
    plane.mean += weights[j] * around[j].offset;
    plane.normal += weights[j] * around[j].normal;
    plane.weight += weights[j];
  }
  plane.mean /= plane.weight;
  plane.normal = glm::normalize(plane.normal);
  double sum = 0.0;
  for (std::size_t j = 0; j < around.size(); ++j) {
    const double height = glm::dot(plane.normal, around[j].offset - plane.mean);
    sum += weights[j] * height * height;
  }
  plane.deviation = std::sqrt(sum / plane.weight);
  return plane;
}

Plane fit_robust_plane(std::span<const Near> around) {
  std::array<double, MOST + 1> weights;
  for (std::size_t j = 0; j < around.size(); ++j) weights[j] = around[j].weight;
  Plane plane = fit_plane(around, weights);
  for (int round = 0; round < REWEIGHTINGS && plane.deviation > 0.0; ++round) {
    for (std::size_t j = 0; j < around.size(); ++j) {
      const double height = glm::dot(plane.normal, around[j].offset - plane.mean) / (WIDE * plane.deviation);
      weights[j] = around[j].weight / ((1.0 + height * height) * (1.0 + height * height));
    }
    plane = fit_plane(around, weights);
  }
  return plane;
}

}  // namespace

Smoothed smooth_points(Cloud& cloud, const std::vector<float>& reach, double radius, bool sided,
                       const Stage& stage) {
  if (cloud.size() == 0) return {};
  std::vector<float> ranked = reach;
  select_nth(std::span(ranked), ranked.size() / 2, std::identity());
  const float usual = ranked[ranked.size() / 2];
  const NeighbourSearch search(cloud, Sites::oriented_positions);
  std::vector<glm::dvec3> moved(cloud.size());
  std::vector<glm::vec3> turned(cloud.size());
  std::vector<float> distance(cloud.size(), -1.0F);
  parallel_each(stage, cloud.size(), [&](std::size_t i) {
    const float limit = radius > 0.0 ? static_cast<float>(radius) : REACHES * std::max(reach[i], usual);
    std::array<Neighbour, MOST> nearest;
    const std::size_t found = search.find_within(cloud.coord[i], nearest, limit * limit);
    const double widest = found == MOST ? nearest[MOST - 1].distance_squared() : limit * limit;
    const glm::dvec3 own(cloud.normal[i]);
    std::array<Near, MOST + 1> around;
    around[0] = {glm::dvec3(0.0), own, 1.0};
    std::size_t count = 1;
    for (std::size_t j = 0; j < found; ++j) {
      const std::uint32_t other = nearest[j].index();
      glm::dvec3 normal(cloud.normal[other]);
      double cosine = glm::dot(own, normal);
      if (!sided && cosine < 0.0) normal = -normal, cosine = -cosine;
      const double share = 1.0 - nearest[j].distance_squared() / widest;
      if (!(cosine > 0.0) || !(share > 0.0)) continue;
      around[count++] = {glm::dvec3(cloud.coord[other] - cloud.coord[i]), normal, share * share * cosine};
    }
    if (static_cast<double>(count - 1) < LEAST_WEIGHED) return;
    const Plane plane = fit_robust_plane(std::span(around).first(count));
    const double height = glm::dot(plane.normal, plane.mean);
    moved[i] = cloud.position[i] + plane.normal * (height * cloud.half_extent_world);
    turned[i] = glm::vec3(plane.normal);
    distance[i] = static_cast<float>(std::abs(height));
  });
  const auto kept = numbers_where(cloud.size(), [&](std::size_t i) { return distance[i] >= 0.0F; });
  Smoothed smoothed{kept.size(), cloud.size() - kept.size(), 0.0};
  cloud.position = std::move(moved);
  cloud.normal = std::move(turned);
  keep_points(cloud, kept);
  order_points(cloud);
  distance = gather(distance, kept);
  if (distance.empty()) return smoothed;
  select_nth(std::span(distance), distance.size() / 2, std::identity());
  smoothed.moved_median_world = distance[distance.size() / 2] * cloud.half_extent_world;
  return smoothed;
}

}  // namespace splatray
