#include "preprocess/scan/smooth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "preprocess/base/select.h"
#include "preprocess/surface/neighbours.h"

namespace splatray {
namespace {

constexpr std::size_t MOST = 64;         // neighbours
constexpr std::size_t LEAST_AROUND = 6;  // of them, that have any weight
constexpr float REACHES = 2.5F;          // of the distance to the 8th place: about 4 spacings
constexpr int REWEIGHTINGS = 2;
constexpr double WIDE = 4.0;  // of the heights' standard deviation: what is farther off has little weight

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

/// The points on their way: cloud coordinates and normals.
struct Moving {
  std::vector<glm::dvec3> place;
  std::vector<glm::vec3> normal;
  std::vector<std::uint8_t> supported;  ///< has enough neighbours
};

/// Moves points by their neighbours, which are looked for where they were first.
class Projection {
 public:
  Projection(const Cloud& cloud, const std::vector<float>& reach, double radius, bool sided)
      : cloud_(cloud),
        reach_(reach),
        radius_(radius),
        sided_(sided),
        search_(cloud, Sites::oriented_positions) {
    std::vector<float> ranked = reach;
    select_nth(std::span(ranked), ranked.size() / 2, std::identity());
    usual_ = ranked[ranked.size() / 2];
  }

  void move(const Moving& from, std::uint32_t i, Moving& to) const {
    std::array<Near, MOST + 1> around;
    const std::size_t count = look_around(from, i, around);
    to.supported[i] = count > LEAST_AROUND;
    to.place[i] = from.place[i];
    to.normal[i] = from.normal[i];
    if (to.supported[i] == 0) return;
    const Plane plane = fit_robust_plane(std::span(around).first(count));
    to.place[i] += plane.normal * glm::dot(plane.normal, plane.mean);
    to.normal[i] = glm::vec3(plane.normal);
  }

 private:
  /// Neighbours that have any weight, after the point itself.
  std::size_t look_around(const Moving& from, std::uint32_t i, std::array<Near, MOST + 1>& around) const {
    const float limit = radius_ > 0.0 ? static_cast<float>(radius_) : REACHES * std::max(reach_[i], usual_);
    std::array<Neighbour, MOST> nearest;
    const std::size_t found = search_.find_within(cloud_.coord[i], nearest, limit * limit);
    const double widest = found == MOST ? nearest[MOST - 1].distance_squared() : limit * limit;
    const glm::dvec3 own(from.normal[i]);
    around[0] = {glm::dvec3(0.0), own, 1.0};
    std::size_t count = 1;
    for (std::size_t j = 0; j < found; ++j) {
      const std::uint32_t other = nearest[j].index();
      glm::dvec3 normal(from.normal[other]);
      double cosine = glm::dot(own, normal);
      if (!sided_ && cosine < 0.0) normal = -normal, cosine = -cosine;
      const double share = 1.0 - nearest[j].distance_squared() / widest;
      if (cosine > 0.0 && share > 0.0)
        around[count++] = {from.place[other] - from.place[i], normal, share * share * cosine};
    }
    return count;
  }

  const Cloud& cloud_;
  const std::vector<float>& reach_;
  double radius_;
  bool sided_;
  NeighbourSearch search_;
  float usual_ = 0.0F;
};

}  // namespace

Smoothed smooth_points(Cloud& cloud, const std::vector<float>& reach, double radius, bool sided,
                       const Stage& stage) {
  if (cloud.size() == 0) return {};
  const std::size_t size = cloud.size();
  Moving now{{cloud.coord.begin(), cloud.coord.end()}, cloud.normal, std::vector<std::uint8_t>(size)};
  {
    const Projection projection(cloud, reach, radius, sided);
    Moving next{std::vector<glm::dvec3>(size), std::vector<glm::vec3>(size), std::vector<std::uint8_t>(size)};
    parallel_each(stage, size,
                  [&](std::size_t i) { projection.move(now, static_cast<std::uint32_t>(i), next); });
    now = std::move(next);
  }
  const auto kept = numbers_where(size, [&](std::size_t i) { return now.supported[i] != 0; });
  if (kept.empty()) return {};  // nothing supports anything: the radius is too small for these points
  std::vector<float> moved(kept.size());
  tbb::parallel_for(std::size_t{0}, kept.size(), [&](std::size_t n) {
    const std::uint32_t i = kept[n];
    const glm::dvec3 by = now.place[i] - glm::dvec3(cloud.coord[i]);
    cloud.position[i] += by * cloud.half_extent_world;
    moved[n] = static_cast<float>(glm::length(by));
  });
  cloud.normal = std::move(now.normal);
  keep_points(cloud, kept);
  order_points(cloud);
  Smoothed smoothed{kept.size(), size - kept.size(), 0.0};
  if (moved.empty()) return smoothed;
  select_nth(std::span(moved), moved.size() / 2, std::identity());
  smoothed.moved_median_world = moved[moved.size() / 2] * cloud.half_extent_world;
  return smoothed;
}

}  // namespace splatray
