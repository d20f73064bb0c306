#include "preprocess/surface/edge_planes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include "engine/base/vector_clones.h"
#include "preprocess/base/lanes.h"

namespace splatray {
namespace {

constexpr unsigned SELF_BIT = Around::MOST;
constexpr std::array<std::size_t, 3> COUNTS = {
    24, 16, 12};                              // of neighbours, of which the first that shows sides is taken
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

/// Planes that are tried, through one place and two others each, and the places that they are to hold; all beside the first.
struct Trials {
  static constexpr std::size_t MOST = TRIED_NEIGHBOURS * (TRIED_NEIGHBOURS - 1) / 2,
                               ROOM = (MOST + LANES - 1) / LANES * LANES;

  float b[3][ROOM], c[3][ROOM];
  std::size_t count = 0;
  float place[Around::MOST + 1][3];
  float factor[Around::MOST + 1];  ///< 1 / what is farthest on a plane there, squared
  std::size_t places = 0;
  std::span<const EdgePlane> before;

  void add_place(const glm::dvec3& first, const glm::dvec3& x) {
    for (glm::length_t k = 0; k < 3; ++k) place[places][k] = static_cast<float>(x[k] - first[k]);
    const double farthest = THICKNESS + BEND * glm::dot(x, x);
    factor[places++] = static_cast<float>(1.0 / (farthest * farthest));
  }
  void add_plane(const float (&through_b)[3], const float (&through_c)[3]) {
    for (std::size_t k = 0; k < 3; ++k) b[k][count] = through_b[k], c[k][count] = through_c[k];
    ++count;
  }
};

/// How well the plane of each trial fits the places; 0 of those through thin corners, and of what is parallel to a plane before.
SPLATRAY_VECTOR_CLONES void score_trials(const Trials& trials, float* scores) {
  constexpr auto LEAST = static_cast<float>(LEAST_SINE * LEAST_SINE);
  constexpr auto MOST = static_cast<float>(PARALLEL_COSINE * PARALLEL_COSINE);
  for (std::size_t t = 0; t < trials.count; t += LANES) {
    Lanes bx, by, bz, cx, cy, cz;
    load_lanes(trials.b[0] + t, bx), load_lanes(trials.b[1] + t, by), load_lanes(trials.b[2] + t, bz);
    load_lanes(trials.c[0] + t, cx), load_lanes(trials.c[1] + t, cy), load_lanes(trials.c[2] + t, cz);
    const Lanes nx = by * cz - bz * cy, ny = bz * cx - bx * cz, nz = bx * cy - by * cx;
    const Lanes area = nx * nx + ny * ny + nz * nz;  // squared
    LaneInts taken = area > LEAST * (bx * bx + by * by + bz * bz) * (cx * cx + cy * cy + cz * cz);
    for (const EdgePlane& plane : trials.before) {
      const glm::vec3 n(plane.normal);
      const Lanes along = n.x * nx + n.y * ny + n.z * nz;
      taken &= along * along <= MOST * area;
    }
    const Lanes inverse = 1.0F / area;
    Lanes score{};
    for (std::size_t j = 0; j < trials.places; ++j) {
      const float(&x)[3] = trials.place[j];
      const Lanes off = x[0] * nx + x[1] * ny + x[2] * nz;
      const Lanes fit = 1.0F - off * off * (inverse * trials.factor[j]);
      score += fit > 0.0F ? fit : Lanes{};
    }
    store_lanes(taken ? score : Lanes{}, scores + t);
  }
}

/// The plane that fits the `wanted` points best, through three of them of which the first is `from` and the others
/// are close, and that crosses those found `before`: what is parallel to them meets them nowhere near.
std::optional<EdgePlane> best_plane(const Around& around, unsigned from, Members wanted,
                                    std::span<const EdgePlane> before) {
  Trials trials;
  trials.before = before;
  const glm::dvec3 first = place_of(around, from);
  std::array<unsigned, Around::MOST + 1> others;
  for (unsigned j = 0; j <= SELF_BIT; ++j) {
    if (j == from || (wanted >> j & 1U) == 0) continue;
    others[trials.places] = j;
    trials.add_place(first, place_of(around, j));
  }
  const std::size_t close = std::min(trials.places, TRIED_NEIGHBOURS);
  std::array<std::pair<unsigned, unsigned>, Trials::MOST> through;
  for (std::size_t b = 0; b < close; ++b)
    for (std::size_t c = b + 1; c < close; ++c) {
      through[trials.count] = {others[b], others[c]};
      trials.add_plane(trials.place[b], trials.place[c]);
    }
  for (std::size_t t = trials.count; t % LANES != 0; ++t)
    for (std::size_t k = 0; k < 3; ++k) trials.b[k][t] = trials.c[k][t] = 0.0F;
  std::array<float, Trials::ROOM> scores;
  score_trials(trials, scores.data());
  const auto best =
      std::max_element(scores.begin(), scores.begin() + static_cast<std::ptrdiff_t>(trials.count));
  if (trials.count == 0 || !(*best > 0.0F)) return {};
  const auto [b, c] = through[static_cast<std::size_t>(best - scores.begin())];
  const glm::dvec3 normal =
      glm::normalize(glm::cross(place_of(around, b) - first, place_of(around, c) - first));
  return EdgePlane{normal, glm::dot(normal, first)};
}

/// The one to three planes that the neighbourhood consists of; nothing where it does not.
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
  if (!explained) return {};
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

std::vector<Side> sides_of(const Around& around, const PointPlanes& edges, double crease) {
  std::vector<Side> sides;
  for (std::size_t i = 0; i < edges.count; ++i) {
    const EdgePlane& own = edges.planes[i];
    if (!own.holds(glm::dvec3(0.0))) continue;
    Side side{own.normal, {}, 0};
    for (std::size_t k = 0; k < edges.count; ++k) {
      if (k == i || side.count == side.lines.size()) continue;
      const auto line = line_between(around, own, edges.planes[k]);
      const auto back = line_between(around, edges.planes[k], own);
      if (!line || !back || turn_of(*line, *back) < crease || line->distance > around.reach()) continue;
      side.lines[side.count++] = *line;
    }
    if (side.count > 0) sides.push_back(side);
  }
  return sides;
}

}  // namespace

std::vector<Side> find_sides(Around& around, double crease) {
  for (const std::size_t count : COUNTS) {
    around.count = std::min(around.count, count);
    const auto edges = find_planes(around);
    if (!edges) continue;
    if (edges->count == 1) break;  // fewer neighbours lie on it, too
    std::vector<Side> sides = sides_of(around, *edges, crease);
    if (!sides.empty()) return sides;
  }
  return {};
}

bool is_flat(const Around& around) {
  const Members all = SELF | ((1U << around.count) - 1U);
  const auto plane = best_plane(around, SELF_BIT, all, {});
  return plane && members_of(around, *plane) == all;
}

}  // namespace splatray
