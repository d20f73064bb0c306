#include "preprocess/base/far_points.h"

#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <functional>
#include <span>
#include <tuple>

#include "preprocess/base/parallel.h"
#include "preprocess/base/select.h"

namespace splatray {
namespace {

constexpr double FAR_APART = 20.0;       // of far points, in units of the others' longest side
constexpr std::size_t HANDFUL = 16;      // far places that any number of points may have ...
constexpr std::size_t ONE_OF = 1000;     // ... or one of this many points,
constexpr std::size_t LEAST_SHARE = 20;  // but not more than one of these

using Positions = std::vector<glm::dvec3>;

/// In the largest of the axes; 0 inside.
double distance_to(const Bounds& box, const glm::dvec3& place) {
  const glm::dvec3 off = glm::max(box.low - place, place - box.high);
  return std::max({off.x, off.y, off.z, 0.0});
}

/// Whether the points, along the longest axis of their box, are in so few places as they must be where a handful of them is
/// far from all others. Ends early where they are not.
bool are_clustered(const Positions& positions, const Bounds& box, std::size_t most) {
  const glm::dvec3 sides = box.high - box.low;
  const int axis = sides.x >= sides.y && sides.x >= sides.z ? 0 : sides.y >= sides.z ? 1 : 2;
  const std::size_t slabs = 4 * most + 64;
  const std::size_t most_filled = most + static_cast<std::size_t>(static_cast<double>(slabs) / FAR_APART) + 2;
  std::vector<bool> filled(slabs, false);
  std::size_t count = 0;
  for (const glm::dvec3& place : positions) {
    const double share = (place[axis] - box.low[axis]) / sides[axis];
    const std::size_t slab =
        std::min(static_cast<std::size_t>(share * static_cast<double>(slabs)), slabs - 1);
    if (filled[slab]) continue;
    filled[slab] = true;
    if (++count > most_filled) return false;
  }
  return true;
}

/// The box of the middle quarter along each axis: whatever a handful of points may be, it is none of it.
Bounds middle_box(const Positions& positions) {
  Bounds box;
  std::vector<double> values(positions.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(positions.begin(), positions.end(), values.begin(),
                   [axis](const glm::dvec3& place) { return place[axis]; });
    const auto ranked = [&](std::size_t rank) {
      select_nth(std::span(values), rank, std::identity());
      return values[rank];
    };
    box.low[axis] = ranked(values.size() * 3 / 8);
    box.high[axis] = ranked(values.size() * 5 / 8);
  }
  return box;
}

/// The points outside `middle`, beyond FAR_APART of its sides: the farthest first.
std::vector<std::uint32_t> points_away(const Positions& positions, const Bounds& middle) {
  const double reach = FAR_APART * longest_side(middle);
  auto numbers = numbers_where(positions.size(),
                               [&](std::size_t i) { return distance_to(middle, positions[i]) > reach; });
  const auto key = [&](std::uint32_t i) {
    const glm::dvec3& place = positions[i];
    return std::tuple(-distance_to(middle, place), place.x, place.y, place.z);
  };
  std::sort(numbers.begin(), numbers.end(),
            [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  return numbers;
}

/// How many of these points, from the first on, are at no more than `most` places. Equal ones follow each other.
std::size_t first_places(const Positions& positions, const std::vector<std::uint32_t>& numbers,
                         std::size_t most) {
  std::size_t places = 0, end = 0;
  for (; end < numbers.size(); ++end) {
    const bool is_same = end > 0 && positions[numbers[end]] == positions[numbers[end - 1]];
    if (!is_same && ++places > most) break;
  }
  return end;
}

/// The box of all points but these, ascending.
Bounds box_without(const Positions& positions, const std::vector<std::uint32_t>& numbers) {
  Bounds box;
  auto next = numbers.begin();
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (next != numbers.end() && *next == i)
      ++next;
    else
      box.add(positions[i]);
  }
  return box;
}

}  // namespace

Bounds bounds_of(const std::vector<glm::dvec3>& positions) {
  using Range = tbb::blocked_range<std::size_t>;
  const auto add = [&](const Range& range, Bounds bounds) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) bounds.add(positions[i]);
    return bounds;
  };
  const auto join = [](Bounds a, const Bounds& b) { return a.add(b), a; };
  return tbb::parallel_reduce(Range(0, positions.size()), Bounds{}, add, join);
}

FarPoints find_far_points(const Positions& positions) {
  FarPoints far;
  far.others = bounds_of(positions);
  const std::size_t most =
      std::min(std::max(HANDFUL, positions.size() / ONE_OF), positions.size() / LEAST_SHARE);
  if (most == 0 || !(longest_side(far.others) > 0.0) || !are_clustered(positions, far.others, most))
    return far;
  std::vector<std::uint32_t> away = points_away(positions, middle_box(positions));
  away.resize(first_places(positions, away, most));
  std::sort(away.begin(), away.end());
  const Bounds most_of_it = box_without(positions, away);
  const double side = longest_side(most_of_it);
  if (!(side > 0.0)) return far;  // one place alone has no scale
  std::erase_if(away,
                [&](std::uint32_t i) { return !(distance_to(most_of_it, positions[i]) > FAR_APART * side); });
  if (away.empty()) return far;
  far.others = box_without(positions, away);
  far.nearest_world = INFINITY;
  for (const std::uint32_t i : away) {
    const double distance = distance_to(far.others, positions[i]);
    far.nearest_world = std::min(far.nearest_world, distance);
    far.farthest_world = std::max(far.farthest_world, distance);
  }
  far.numbers = std::move(away);
  return far;
}

}  // namespace splatray
