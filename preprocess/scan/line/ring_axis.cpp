#include <algorithm>
#include <cmath>
#include <functional>
#include <span>

#include "preprocess/base/select.h"
#include "preprocess/scan/line/lines.h"

namespace splatray {
namespace {

constexpr std::size_t MOST_ASKED = 1U << 18;  // as many as rows of a tripod's scan have enough of
constexpr std::size_t LEAST_RINGS = 8, LEAST_ON_RING = 32;
constexpr double STEPS_ON_RINGS =
    1.0 - 1.0 / LEAST_ON_RING;  // share of the steps from one elevation to the next
/// Bound of step_on_rings: random elevations have ln LEAST_ON_RING, 3.5; rings with deviations of a twentieth of their distance have 1.
constexpr double SHARP = 1.0;
/// Different ranges, by a thousandth, that a ring has at least which runs over things: what was turned, milled or stacked in rows has few.
constexpr std::size_t LEAST_RANGES = 16;
constexpr float SAME_RANGE = 1.001F;
constexpr std::size_t LEAST_UNEVEN =
    10;  // one of so many points lies on such rings: of a small empty room most lie on round ones

/// A point as a scanner sees it.
struct Seen {
  float elevation, range;
};

std::vector<Seen> seen_from(const Cloud& cloud, const std::vector<std::uint32_t>& points,
                            const glm::dvec3& sensor, int axis) {
  std::vector<Seen> seen;
  const std::size_t stride = points.size() / MOST_ASKED + 1;
  for (std::size_t n = 0; n < points.size(); n += stride) {
    const glm::dvec3 to = cloud.in_cloud(cloud.place_world(points[n])) - sensor;
    const double range = glm::length(to);
    if (range > 0.0)
      seen.push_back({static_cast<float>(std::asin(to[axis] / range)), static_cast<float>(range)});
  }
  std::sort(seen.begin(), seen.end(), [](const Seen& a, const Seen& b) { return a.elevation < b.elevation; });
  return seen;
}

/// The longest of the steps from one elevation to the next that are within rings, if there are rings, over the mean of all.
double step_on_rings(const std::vector<Seen>& seen, double mean) {
  std::vector<float> steps;
  for (std::size_t n = 1; n < seen.size(); ++n) steps.push_back(seen[n].elevation - seen[n - 1].elevation);
  const auto rank = static_cast<std::size_t>(STEPS_ON_RINGS * static_cast<double>(steps.size() - 1));
  select_nth(std::span(steps), rank, std::identity());
  return steps[rank] / mean;
}

/// Whether a ring's points have many ranges.
bool has_many_ranges(std::span<const Seen> ring) {
  std::vector<float> ranges(ring.size());
  std::transform(ring.begin(), ring.end(), ranges.begin(), [](const Seen& one) { return one.range; });
  std::sort(ranges.begin(), ranges.end());
  std::size_t count = 1;
  float last = ranges.front();
  for (const float range : ranges)
    if (range > SAME_RANGE * last) last = range, ++count;
  return count >= LEAST_RANGES;
}

/// Whether these are on enough rings, some of which run over things.
bool are_rings(const std::vector<Seen>& seen, double mean) {
  std::size_t rings = 0, uneven = 0;
  for (std::size_t first = 0, n = 1; n <= seen.size(); ++n) {
    if (n < seen.size() && seen[n].elevation - seen[n - 1].elevation <= mean) continue;
    const auto ring = std::span(seen).subspan(first, n - first);
    rings += ring.size() >= LEAST_ON_RING ? 1 : 0;
    uneven += ring.size() >= LEAST_ON_RING && has_many_ranges(ring) ? ring.size() : 0;
    first = n;
  }
  return rings >= LEAST_RINGS && LEAST_UNEVEN * uneven > seen.size();
}

}  // namespace

std::optional<glm::dvec3> find_ring_axis(const Cloud& cloud, const std::vector<std::uint32_t>& points,
                                         const glm::dvec3& sensor) {
  std::optional<glm::dvec3> best;
  double least = SHARP;
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<Seen> seen = seen_from(cloud, points, sensor, axis);
    if (seen.size() < LEAST_RINGS * LEAST_ON_RING) return {};
    const double mean = (seen.back().elevation - seen.front().elevation) / static_cast<double>(seen.size());
    if (!(mean > 0.0)) continue;
    const double step = step_on_rings(seen, mean);
    if (!(step < least) || !are_rings(seen, mean)) continue;
    least = step;
    best = glm::dvec3(axis == 0, axis == 1, axis == 2);
  }
  return best;
}

}  // namespace splatray
