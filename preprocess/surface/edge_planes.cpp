#include "preprocess/surface/edge_planes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>

namespace splatray {
namespace {

constexpr unsigned SELF_BIT = Around::MOST;
constexpr std::size_t TRIED_NEIGHBOURS = 12;  // neighbours that planes are tried through
constexpr double THICKNESS = 0.05;            // of the spacing: farther points are on no plane
constexpr double BEND = 0.05;  // and as much more times the square of how far they are, as surfaces bend
constexpr std::size_t OWN_LEAST = 3;      // points that a plane has alone
constexpr double UNEXPLAINED_MOST = 0.1;  // of the neighbours, on no plane
constexpr double LEAST_SINE = 0.3;        // of a triple's corner: thinner triples determine no plane
constexpr double PARALLEL_COSINE = 0.97;  // 14 degrees

struct EdgePlane {
  glm::dvec3 normal;  ///< unit
  double distance;    ///< normal . x of its points

  /// 1 of a point on it, 0 of the farthest that still belongs to it, less of others.
  [[nodiscard]] double fit(const glm::dvec3& x) const {
    const double off = (glm::dot(normal, x) - distance) / (THICKNESS + BEND * glm::dot(x, x));
    return 1.0 - off * off;
  }
  [[nodiscard]] bool holds(const glm::dvec3& x) const { return fit(x) >= 0.0; }
};

/// A point's planes, the first through it, and the lines at which each of them ends.
struct PointPlanes {
  std::array<EdgePlane, 3> planes;
  std::size_t count = 0;
};

std::optional<EdgePlane> plane_through(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 across = glm::cross(b - a, c - a);
  const double area = glm::length(across);
  if (!(area > LEAST_SINE * glm::length(b - a) * glm::length(c - a))) return {};
  const glm::dvec3 normal = across / area;
  return EdgePlane{normal, glm::dot(normal, a)};
}

/// Which of the neighbours are on a plane, a bit each; the point itself is bit SELF_BIT.
using Members = std::uint32_t;
constexpr Members SELF = 1U << SELF_BIT;

Members members_of(const Around& around, const EdgePlane& plane) {
  Members members = plane.holds(glm::dvec3(0.0)) ? SELF : 0;
  for (std::size_t j = 0; j < around.count; ++j)
    if (plane.holds(around.offset[j])) members |= 1U << j;
  return members;
}

glm::dvec3 place_of(const Around& around, unsigned bit) {
  return bit == SELF_BIT ? glm::dvec3(0.0) : around.offset[bit];
}

/// The plane that fits the `wanted` points best, through three of them of which the first is `from` and the others
/// are close, and that crosses those found `before`: what is parallel to them meets them nowhere near.
std::optional<EdgePlane> best_plane(const Around& around, unsigned from, Members wanted,
                                    std::span<const EdgePlane> before) {
  std::optional<EdgePlane> best;
  double most = 0.0;
  const glm::dvec3 first = place_of(around, from);
  std::size_t tried_b = 0;
  for (unsigned b = 0; b <= SELF_BIT && tried_b < TRIED_NEIGHBOURS; ++b) {
    if (b == from || (wanted >> b & 1U) == 0) continue;
    std::size_t tried_c = ++tried_b;
    for (unsigned c = b + 1; c <= SELF_BIT && tried_c < TRIED_NEIGHBOURS; ++c) {
      if (c == from || (wanted >> c & 1U) == 0) continue;
      ++tried_c;
      const auto plane = plane_through(first, place_of(around, b), place_of(around, c));
      const auto parallel = [&](const EdgePlane& other) {
        return std::abs(glm::dot(other.normal, plane->normal)) > PARALLEL_COSINE;
      };
      if (!plane || std::any_of(before.begin(), before.end(), parallel)) continue;
      double score = 0.0;
      for (unsigned j = 0; j <= SELF_BIT; ++j)
        if ((wanted >> j & 1U) != 0) score += std::max(plane->fit(place_of(around, j)), 0.0);
      if (score > most) best = plane, most = score;
    }
  }
  return best;
}

/// The two or three planes that the neighbourhood consists of; nothing where it does not.
std::optional<PointPlanes> find_planes(const Around& around) {
  PointPlanes edges;
  Members left = SELF | ((1U << around.count) - 1U);
  unsigned from = SELF_BIT;
  while (edges.count < 3) {
    const auto plane = best_plane(around, from, left, std::span(edges.planes).first(edges.count));
    if (!plane) break;
    const Members held = members_of(around, *plane);
    if (std::popcount(held & left) < static_cast<int>(OWN_LEAST)) break;
    edges.planes[edges.count++] = *plane;
    left &= ~held;
    if (std::popcount(left) < static_cast<int>(OWN_LEAST)) break;
    from = static_cast<unsigned>(std::countr_zero(left));
  }
  const bool explained =
      std::popcount(left) <= static_cast<int>(UNEXPLAINED_MOST * static_cast<double>(around.count));
  if (edges.count < 2 || !explained) return {};
  return edges;
}

/// Where `own` ends at `other`: all of its own points are on one side, of which there are enough.
std::optional<Line> line_between(const Around& around, const EdgePlane& own, const EdgePlane& other) {
  const glm::dvec3 along = glm::cross(own.normal, other.normal);
  const double sine = glm::length(along);
  if (!(sine > 0.05)) return {};
  glm::dvec3 out = glm::cross(along / sine, own.normal);
  // On the line: other.normal . (p + s out) = other.distance, where p is the point's foot on `own`.
  const glm::dvec3 foot = own.normal * own.distance;
  const double slope = glm::dot(other.normal, out);
  double at = (other.distance - glm::dot(other.normal, foot)) / slope;
  std::size_t before = 0, behind = 0;
  double farthest[2] = {0.0, 0.0};  // before and behind
  const double slack = THICKNESS / sine;
  for (std::size_t j = 0; j <= around.count; ++j) {
    const glm::dvec3 place = j == around.count ? glm::dvec3(0.0) : around.offset[j];
    if (!own.holds(place)) continue;
    farthest[0] = std::max(farthest[0], glm::dot(out, place)),
    farthest[1] = std::max(farthest[1], -glm::dot(out, place));
    if (other.holds(place)) continue;
    ++(glm::dot(out, place) < at ? before : behind);
  }
  if (std::min(before, behind) > 0 || before + behind < OWN_LEAST) return {};
  if (behind > 0) out = -out, at = -at;
  if (at < -slack) return {};  // the point itself is beyond
  return Line{out, other.normal, std::max(at, farthest[behind > 0 ? 1 : 0])};
}

/// By how much the surface turns at the line that two planes share, given the directions in which each leaves it.
double turn_of(const Line& a, const Line& b) {
  return std::numbers::pi - std::acos(std::clamp(glm::dot(a.out, b.out), -1.0, 1.0));
}

}  // namespace

std::vector<Side> find_sides(const Around& around, double crease) {
  std::vector<Side> sides;
  const auto edges = find_planes(around);
  if (!edges) return sides;
  for (std::size_t i = 0; i < edges->count; ++i) {
    const EdgePlane& own = edges->planes[i];
    if (!own.holds(glm::dvec3(0.0))) continue;
    Side side{own.normal, {}, 0};
    for (std::size_t k = 0; k < edges->count; ++k) {
      if (k == i || side.count == side.lines.size()) continue;
      const auto line = line_between(around, own, edges->planes[k]);
      const auto back = line_between(around, edges->planes[k], own);
      if (!line || !back || turn_of(*line, *back) < crease || line->distance > around.reach()) continue;
      side.lines[side.count++] = *line;
    }
    if (side.count > 0) sides.push_back(side);
  }
  return sides;
}

bool is_flat(const Around& around) {
  const Members all = SELF | ((1U << around.count) - 1U);
  const auto plane = best_plane(around, SELF_BIT, all, {});
  return plane && members_of(around, *plane) == all;
}

}  // namespace splatray
