#include "preprocess/surface/radius.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "engine/base/release.h"
#include "engine/base/vector_clones.h"
#include "preprocess/base/select.h"
#include "preprocess/surface/near_places.h"
#include "preprocess/surface/normal_field.h"
#include "preprocess/surface/sheet.h"
#include "preprocess/surface/voronoi.h"

namespace splatray {
namespace {

constexpr double KNN_FACTOR = 0.65;  // x distance to the EVEN_RING-th neighbour: closed for even samples
constexpr std::size_t FEW_NEIGHBOURS = NearPlaces::LISTED;  // neighbours that settle most Voronoi cells
constexpr std::size_t MEETING_NEIGHBOURS = 8;               // neighbours whose discs meet a point's own
constexpr std::size_t MANY_NEIGHBOURS = 32;                 // neighbours asked for when FEW_NEIGHBOURS do not
constexpr float MANY_OVER_FEW =
    1.3F * MANY_NEIGHBOURS / FEW_NEIGHBOURS;  // of their squared distances on a surface, with some room
constexpr double COVERAGE_MARGIN = 1.02;      // discs of a curved surface lie in different planes
// The same of samples of a mesh, which lie on its facets: beyond an edge, a neighbour's disc lies beside this facet. Of 1 M samples holes
// are half as many as with the margin above, wrong pixels 1.07 times (igea, gears, nefertiti).
constexpr double FACETS_MARGIN = 1.06;
// More where discs lie at different heights, in standard deviations of the heights.
constexpr double ROUGHNESS_REACH = 1.0;
constexpr double LEAST_SLANT = 0.5;      // sine of the angle between planes that meet in a crease
constexpr double LAYERS_COSINE = 0.9;    // cosine of normals of layers of one noisy sheet
constexpr double NOISE_REACH = 4.0;      // of a noisy sheet's disc, in standard deviations of its heights
constexpr double NOISE_LIMIT = 2.0;      // the same at most, in units of the disc that covers
constexpr float STRAY = 4.0F;            // largest radius in units of the surroundings' median
constexpr std::size_t SURROUNDING = 16;  // neighbours that show what distance is usual around a point
// The ratio of their squared distances to that of the EVEN_RING-th on a surface, with some room.
constexpr float SURROUNDING_OVER_RING = 1.3F * SURROUNDING / EVEN_RING;
constexpr float CLOSED = 2.2F;  // radius of a closed cell, at most, in units of it: no even sample has more

double knn_radius(const Cloud& cloud, const NeighbourSearch& search, std::uint32_t point) {
  std::array<Neighbour, EVEN_RING> nearest;
  const std::size_t count = search.find(cloud.coord[point], nearest);
  return count == 0 ? 0.0 : KNN_FACTOR * std::sqrt(nearest[count - 1].distance_squared());
}

/// What surrounds a point on its tangent plane. Neighbours of the point's own sheet are turned into the plane with their
/// distance kept, so that curvature does not shrink the cell. Those on the far side of a sharp edge give the line where
/// their plane meets this one.
class DiscSurroundings {
 public:
  explicit DiscSurroundings(const Neighbourhood& around) : around_(around) {
    const glm::dvec3& normal = around.normal;
    const glm::dvec3 side = std::abs(normal.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(normal, side));
    const glm::dvec3 v = glm::cross(normal, u);
    for (std::size_t i = 0; i < around.clip.lines(); ++i) {
      const glm::dvec3 dir(around.clip.dir[i]);
      creases_[crease_count_++] = {glm::dvec2(glm::dot(dir, u), glm::dot(dir, v)), around.clip.distance[i]};
    }
    around.normals.dot(normal, around.count, alignment_);
    around.offset.dot(u, around.count, across_u_);
    around.offset.dot(v, around.count, across_v_);
    for (std::size_t j = 0; j < around.count; ++j) {
      distance_[j] = std::sqrt(static_cast<float>(around.distance_squared[j]));
      lateral_[j] = std::sqrt(across_u_[j] * across_u_[j] + across_v_[j] * across_v_[j]);
      stretch_[j] = distance_[j] / lateral_[j];
    }
    for (std::size_t j = 0; j < around.count; ++j) {
      if ((around.oriented ? alignment_[j] : std::abs(alignment_[j])) < SHEET_COSINE) {
        if (!around.creases_known) add_crease(j, u, v);
      } else if (!(lateral_[j] < SHEET_LATERAL * distance_[j])) {
        neighbours_[neighbour_count_++] = {glm::dvec2(across_u_[j], across_v_[j]) * stretch_[j],
                                           distance_[j]};
      }
    }
  }

  [[nodiscard]] std::span<const TangentNeighbour> neighbours() const {
    return std::span(neighbours_).first(neighbour_count_);
  }
  [[nodiscard]] std::span<const TangentCrease> creases() const {
    return std::span(creases_).first(crease_count_);
  }

  /// Standard deviation of the heights over the point's plane of the `most` nearest points that lie parallel.
  [[nodiscard]] double noise(std::size_t most) const {
    double count = 1.0, sum = 0.0, sum_squared = 0.0;
    for (std::size_t j = 0; j < std::min(most, around_.count); ++j) {
      if (alignment_[j] < LAYERS_COSINE) continue;
      const double height = glm::dot(around_.normal, offset(j));
      count += 1.0, sum += height, sum_squared += height * height;
    }
    return std::sqrt(std::max(sum_squared / count - sum * sum / (count * count), 0.0));
  }

 private:
  [[nodiscard]] glm::dvec3 offset(std::size_t j) const {
    return {around_.offset.x[j], around_.offset.y[j], around_.offset.z[j]};
  }

  void add_crease(std::size_t j, const glm::dvec3& u, const glm::dvec3& v) {
    const glm::dvec3 normal(around_.normals.x[j], around_.normals.y[j], around_.normals.z[j]);
    const glm::dvec2 across(glm::dot(normal, u), glm::dot(normal, v));
    const double slant = glm::length(across);
    const double height = glm::dot(normal, offset(j));
    const double to_crease = std::abs(height) / slant;
    if (slant < LEAST_SLANT || to_crease > distance_[j] || height == 0.0) return;
    creases_[crease_count_++] = {across / std::copysign(slant, height), to_crease};
  }

  const Neighbourhood& around_;
  NumbersAround alignment_, across_u_, across_v_, distance_, lateral_, stretch_;
  std::array<TangentNeighbour, MANY_NEIGHBOURS> neighbours_;
  std::array<TangentCrease, MANY_NEIGHBOURS + 2> creases_;
  std::size_t neighbour_count_ = 0;
  std::size_t crease_count_ = 0;
};

/// A radius that covers its point's cell, and whether the cell is open.
struct Covering {
  double radius = 0.0;
  bool open = false;
};

/// The radius that covers the point's cell, 0 where there is none; nothing when `wanted` neighbours do not settle it.
SPLATRAY_VECTOR_CLONES std::optional<Covering> covering_radius(const Neighbourhood& around,
                                                               std::size_t wanted) {
  if (around.found == 0) return Covering{};
  const DiscSurroundings surroundings(around);
  const VoronoiReach reach =
      voronoi_reach(surroundings.neighbours(), surroundings.creases(), around.ends_known);
  const double seen = std::sqrt(around.seen_squared);
  const bool settled = around.found < wanted || wanted == MANY_NEIGHBOURS ||
                       (surroundings.neighbours().size() >= EVEN_RING && reach.decisive_distance <= seen);
  if (!settled || !(reach.radius > 0.0)) return {};
  const double covering = (around.on_facets ? FACETS_MARGIN : COVERAGE_MARGIN) * reach.radius +
                          ROUGHNESS_REACH * surroundings.noise(MEETING_NEIGHBOURS);
  return Covering{std::min(std::max(covering, NOISE_REACH * surroundings.noise(FEW_NEIGHBOURS)),
                           NOISE_LIMIT * reach.radius),
                  reach.open};
}

/// For points whose radii follow their cells, the distance to the EVEN_RING-th neighbour, negative where the cell is open. Empty for
/// points that were not measured: those are as even as they were made.
using Rings = std::vector<float>;

float ring_of(const Neighbourhood& around, bool open) {
  if (around.count == 0) return 0.0F;
  const auto ring =
      static_cast<float>(std::sqrt(around.distance_squared[std::min(EVEN_RING, around.count) - 1]));
  return open ? -ring : ring;
}

/// Calls visit(point, its FEW_NEIGHBOURS nearest sites) for every point; without sites none are near.
template <typename Visit>
void visit_nearest(const Cloud& cloud, const NeighbourSearch* sites, const Stage& stage, const Visit& visit) {
  if (sites && !cloud.near) {
    sites->find_all(FEW_NEIGHBOURS, stage, visit);
    return;
  }
  parallel_each(stage, cloud.size(), [&](std::size_t i) {
    const auto point = static_cast<std::uint32_t>(i);
    std::array<Neighbour, FEW_NEIGHBOURS> nearest;
    visit(point, cloud.near ? cloud.near->find(cloud, point, nearest) : std::span<const Neighbour>());
  });
}

/// Radii that the FEW_NEIGHBOURS nearest places settle; of others the squared distance of the last of these, negative.
float radius_of_few(const Neighbourhood& around, std::uint32_t point, Rings& rings) {
  const auto covering = covering_radius(around, FEW_NEIGHBOURS);
  if (!rings.empty()) rings[point] = ring_of(around, covering && covering->open);
  return covering ? static_cast<float>(covering->radius) : -around.seen_squared;
}

/// Settles what radius_of_few has not.
void look_further(Cloud& cloud, const NeighbourSearch& search, Rings& rings, const Stage& stage) {
  const auto open = numbers_where(cloud.size(), [&](std::size_t i) { return cloud.radius[i] < 0.0F; });
  const auto query = [&](std::uint32_t n) -> NeighbourSearch::Query {
    return {cloud.coord[open[n]], MANY_OVER_FEW * -cloud.radius[open[n]],
            std::numeric_limits<float>::infinity()};
  };
  search.find_each(
      open.size(), query, MANY_NEIGHBOURS, stage, [&](std::uint32_t n, std::span<Neighbour> nearest) {
        const std::uint32_t i = open[n];
        if (!std::is_sorted(nearest.begin(), nearest.end())) std::sort(nearest.begin(), nearest.end());
        const Neighbourhood around(cloud, i, nearest);
        const auto covering = covering_radius(around, MANY_NEIGHBOURS);
        cloud.radius[i] = static_cast<float>(covering ? covering->radius : knn_radius(cloud, search, i));
        if (!rings.empty()) rings[i] = ring_of(around, !covering || covering->open);
      });
}

/// Keeps discs to the distances that are usual around them, those of open cells, whose reach nothing bounds, the most: none
/// spans a hole of the scan.
void bound_wide(Cloud& cloud, const NeighbourSearch& search, const Rings& rings, const Stage& stage) {
  // What is on no surface has its disc already.
  const auto wide = numbers_where(rings.size(), [&](std::size_t i) {
    return cloud.on_surface(i) && (rings[i] < 0.0F || cloud.radius[i] > CLOSED * rings[i]);
  });
  const auto query = [&](std::uint32_t n) -> NeighbourSearch::Query {
    const float reach = rings[wide[n]] == 0.0F ? cloud.radius[wide[n]] : rings[wide[n]];
    return {cloud.coord[wide[n]], SURROUNDING_OVER_RING * reach * reach,
            std::numeric_limits<float>::infinity()};
  };
  search.find_each(
      wide.size(), query, SURROUNDING, stage, [&](std::uint32_t n, std::span<Neighbour> nearest) {
        const std::uint32_t i = wide[n];
        const float ring = std::abs(rings[i]);
        std::array<float, SURROUNDING> around;
        for (std::size_t j = 0; j < nearest.size(); ++j) around[j] = std::abs(rings[nearest[j].index()]);
        const float usual = nearest.empty() ? 0.0F : median_of(std::span(around).first(nearest.size()));
        if (!(usual > 0.0F)) return;
        if (!(rings[i] < 0.0F)) {
          cloud.radius[i] = std::min(cloud.radius[i], CLOSED * std::max(ring, usual));
        } else if (ring > MOST_OVER_USUAL * usual) {
          cloud.radius[i] =
              std::min(cloud.radius[i], static_cast<float>(KNN_FACTOR) * MOST_OVER_USUAL * usual);
        }
      });
}

/// Keeps stray points from covering the scene with discs as wide as their distance to it.
void bound_strays(Cloud& cloud, const NeighbourSearch& search, const std::vector<std::uint32_t>& computed) {
  std::vector<float> radii = gather(cloud.radius, computed);
  const float limit = STRAY * median_of(std::span(radii));
  release(radii);
  const std::vector<float> before = cloud.radius;
  tbb::parallel_for(std::size_t{0}, computed.size(), [&](std::size_t n) {
    float& radius = cloud.radius[computed[n]];
    if (!(radius > limit)) return;
    std::array<Neighbour, FEW_NEIGHBOURS> nearest;
    std::array<float, FEW_NEIGHBOURS> around;
    const std::size_t found = search.find(cloud.coord[computed[n]], nearest);
    for (std::size_t j = 0; j < found; ++j) around[j] = before[nearest[j].index()];
    radius = std::min(radius, STRAY * median_of(std::span(around).first(found)));
  });
}

}  // namespace

void find_radii(Cloud& cloud, RadiusRule rule, double scale, bool fields, const Stage& stage) {
  cloud.radius.resize(cloud.size(), 0.0F);
  const auto unknown = numbers_where(cloud.size(), [&](std::size_t i) { return cloud.radius[i] == 0.0F; });
  if (fields) cloud.field.resize(cloud.size());
  if (!unknown.empty() || fields) {
    const bool knn = rule == RadiusRule::knn;
    Rings rings(cloud.measured && !knn ? cloud.size() : 0);
    std::optional<NeighbourSearch> own, places;
    const NeighbourSearch* sheets = cloud.near ? &cloud.near->search() : nullptr;
    if (!sheets && (fields || !knn)) sheets = &own.emplace(cloud, Sites::oriented_surface);
    if (knn && !unknown.empty()) places.emplace(cloud, Sites::positions);
    const auto fill = [&](std::uint32_t i, std::span<const Neighbour> nearest) {
      const Neighbourhood around(cloud, i, nearest);
      const bool on_line = cloud.is_ellipse(i);
      if (fields && !on_line) cloud.field[i] = fit_normal_field(around);  // a line alone determines none
      if (cloud.radius[i] != 0.0F) return;
      if (on_line) {
        cloud.radius[i] = cloud.ellipse[i].half_length;
        return;
      }
      cloud.radius[i] =
          static_cast<float>(knn ? knn_radius(cloud, *places, i) : radius_of_few(around, i, rings));
    };
    visit_nearest(cloud, sheets, stage, fill);
    if (sheets && !knn) look_further(cloud, *sheets, rings, stage);
    if (sheets) bound_wide(cloud, *sheets, rings, stage);
    release(rings);
    for (const std::uint32_t i : cloud.radius_most.empty() ? std::vector<std::uint32_t>{} : unknown)
      cloud.radius[i] = std::min(cloud.radius[i], cloud.radius_most[i]);
    if (!unknown.empty()) bound_strays(cloud, knn ? *places : *sheets, unknown);
  }
  cloud.near = {};
  tbb::parallel_for(std::size_t{0}, cloud.size(),
                    [&](std::size_t i) { cloud.radius[i] = static_cast<float>(cloud.radius[i] * scale); });
}

}  // namespace splatray
