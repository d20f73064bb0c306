#include "preprocess/radius.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "preprocess/neighbours.h"
#include "preprocess/normal_field.h"
#include "preprocess/voronoi.h"

namespace splatray {
namespace {

constexpr double KNN_FACTOR = 0.65;       // x distance to the RING-th neighbour: closed for even samples
constexpr std::size_t RING = 6;           // neighbours around a point of an even sampling
constexpr std::size_t FEW = 12;           // neighbours that settle most Voronoi cells
constexpr std::size_t CLOSE = 8;          // neighbours whose discs meet a point's own
constexpr std::size_t MANY = 32;          // neighbours asked for when FEW do not
constexpr double COVERAGE_MARGIN = 1.02;  // discs of a curved surface lie in different planes
// More where discs lie at different heights, in standard deviations of the heights.
constexpr double ROUGHNESS_REACH = 1.0;
constexpr double SIMILAR = 0.5;      // cosine of normals of one sheet
constexpr double LATERAL = 0.5;      // tangential share of the distance of a neighbour on the same sheet
constexpr double LEAST_SLANT = 0.5;  // sine of the angle between planes that meet in a crease
constexpr double PARALLEL = 0.9;     // cosine of normals of layers of one noisy sheet
constexpr double NOISE_REACH = 4.0;  // of a noisy sheet's disc, in standard deviations of its heights
constexpr double NOISE_LIMIT = 2.0;  // the same at most, in units of the disc that covers
constexpr float STRAY = 4.0F;        // largest radius in units of the surroundings' median

double knn_radius(const Cloud& cloud, const NeighbourSearch& search, std::uint32_t point) {
  std::array<Neighbour, RING> nearest;
  const std::size_t count = search.find(cloud.coord[point], nearest);
  return count == 0 ? 0.0 : KNN_FACTOR * std::sqrt(nearest[count - 1].distance_squared());
}

/// What surrounds a point on its tangent plane.
struct Surroundings {
  std::array<TangentNeighbour, MANY> neighbours;
  std::array<TangentCrease, MANY> creases;
  std::size_t neighbour_count = 0;
  std::size_t crease_count = 0;
};

/// Neighbours of the point's own sheet are turned into the plane with their distance kept, so that curvature
/// does not shrink the cell. Those on the far side of a sharp edge give the line where their plane meets this
/// one.
Surroundings flatten(const Cloud& cloud, std::uint32_t point, std::span<const Neighbour> nearest) {
  const glm::dvec3 normal(cloud.normal[point]);
  const glm::dvec3 side = std::abs(normal.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(normal, side));
  const glm::dvec3 v = glm::cross(normal, u);
  const auto on_plane = [&](const glm::dvec3& w) { return glm::dvec2(glm::dot(w, u), glm::dot(w, v)); };
  Surroundings around;
  for (const Neighbour& neighbour : nearest) {
    const glm::dvec3 other_normal(cloud.normal[neighbour.index()]);
    const glm::dvec3 offset(cloud.coord[neighbour.index()] - cloud.coord[point]);
    const double distance = std::sqrt(neighbour.distance_squared());
    const double alignment = glm::dot(normal, other_normal);
    if ((cloud.oriented ? alignment : std::abs(alignment)) < SIMILAR) {
      const glm::dvec2 across = on_plane(other_normal);
      const double slant = glm::length(across);
      const double height = glm::dot(other_normal, offset);
      const double to_crease = std::abs(height) / slant;
      if (slant < LEAST_SLANT || to_crease > distance || height == 0.0) continue;
      around.creases[around.crease_count++] = {across / std::copysign(slant, height), to_crease};
      continue;
    }
    const glm::dvec2 projected = on_plane(offset);
    const double lateral = glm::length(projected);
    if (lateral < LATERAL * distance) continue;
    around.neighbours[around.neighbour_count++] = {projected * (distance / lateral), distance};
  }
  return around;
}

/// Standard deviation of the heights over the point's plane of near points that lie parallel.
double sheet_noise(const Cloud& cloud, std::uint32_t point, std::span<const Neighbour> nearest) {
  const glm::dvec3 normal(cloud.normal[point]);
  double count = 1.0, sum = 0.0, sum_squared = 0.0;
  for (const Neighbour& neighbour : nearest) {
    if (glm::dot(normal, glm::dvec3(cloud.normal[neighbour.index()])) < PARALLEL) continue;
    const double height = glm::dot(normal, glm::dvec3(cloud.coord[neighbour.index()] - cloud.coord[point]));
    count += 1.0, sum += height, sum_squared += height * height;
  }
  return std::sqrt(std::max(sum_squared / count - sum * sum / (count * count), 0.0));
}

/// `nearest`: the FEW nearest places, or all where there are fewer.
double coverage_radius(const Cloud& cloud, const NeighbourSearch& search, std::uint32_t point,
                       std::span<const Neighbour> nearest) {
  std::array<Neighbour, MANY> more;
  for (const std::size_t wanted : {FEW, MANY}) {
    if (wanted == MANY) nearest = std::span(more).first(search.find(cloud.coord[point], more));
    const std::size_t found = nearest.size();
    if (found == 0) return 0.0;
    const Surroundings around = flatten(cloud, point, nearest);
    const VoronoiReach reach = voronoi_reach(std::span(around.neighbours).first(around.neighbour_count),
                                             std::span(around.creases).first(around.crease_count));
    const double seen = std::sqrt(nearest[found - 1].distance_squared());
    const bool settled = found < wanted || wanted == MANY ||
                         (around.neighbour_count >= RING && reach.decisive_distance <= seen);
    if (!settled) continue;
    if (reach.radius > 0.0) {
      const auto heights_among = [&](std::size_t count) {
        return sheet_noise(cloud, point, nearest.first(std::min(found, count)));
      };
      const double covering = COVERAGE_MARGIN * reach.radius + ROUGHNESS_REACH * heights_among(CLOSE);
      return std::min(std::max(covering, NOISE_REACH * heights_among(FEW)), NOISE_LIMIT * reach.radius);
    }
  }
  return knn_radius(cloud, search, point);
}

float median(std::span<float> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Keeps stray points from covering the scene with discs as wide as their distance to it.
void bound_strays(Cloud& cloud, const NeighbourSearch& search, const std::vector<std::uint32_t>& computed) {
  std::vector<float> radii(computed.size());
  for (std::size_t n = 0; n < computed.size(); ++n) radii[n] = cloud.radius[computed[n]];
  const float limit = STRAY * median(radii);
  const std::vector<float> before = cloud.radius;
  tbb::parallel_for(std::size_t{0}, computed.size(), [&](std::size_t n) {
    float& radius = cloud.radius[computed[n]];
    if (!(radius > limit)) return;
    std::array<Neighbour, FEW> nearest;
    std::array<float, FEW> around;
    const std::size_t found = search.find(cloud.coord[computed[n]], nearest);
    for (std::size_t j = 0; j < found; ++j) around[j] = before[nearest[j].index()];
    radius = std::min(radius, STRAY * median(std::span(around).first(found)));
  });
}

}  // namespace

void find_radii(Cloud& cloud, RadiusRule rule, double scale, bool fields, const Stage& stage) {
  std::vector<std::uint32_t> unknown;
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    if (cloud.radius[i] == 0.0F) unknown.push_back(i);
  }
  if (fields) cloud.field.resize(cloud.size());
  if (!unknown.empty() || fields) {
    const bool knn = rule == RadiusRule::knn;
    std::optional<NeighbourSearch> sheets, places;
    if (fields || !knn) sheets.emplace(cloud, Sites::oriented_positions);
    if (knn && !unknown.empty()) places.emplace(cloud, Sites::positions);
    parallel_each(stage, cloud.size(), [&](std::size_t n) {
      const auto i = static_cast<std::uint32_t>(n);
      const bool missing = cloud.radius[i] == 0.0F;
      std::array<Neighbour, FEW> few;
      std::span<const Neighbour> nearest;
      if (fields || (missing && !knn)) nearest = std::span(few).first(sheets->find(cloud.coord[i], few));
      if (fields) cloud.field[i] = fit_normal_field(cloud, i, nearest);
      if (missing) {
        cloud.radius[i] = static_cast<float>(knn ? knn_radius(cloud, *places, i)
                                                 : coverage_radius(cloud, *sheets, i, nearest));
      }
    });
    if (!unknown.empty()) bound_strays(cloud, knn ? *places : *sheets, unknown);
  }
  for (float& radius : cloud.radius) radius = static_cast<float>(radius * scale);
}

}  // namespace splatray
