#include "tests/trace/brute_force_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "engine/scene/splat.h"

namespace splatray::testing {
namespace {

using glm::dvec3;

constexpr std::uint32_t LEAF = 4;
/// Boxes are wider than the balls by this share of the radius and this many lattice units: far more than float64 rounds.
constexpr double WIDER_SHARE = 1e-3, WIDER = 1.0;

/// Whether the line origin + t * dir meets the box at some t.
bool meets(const dvec3& low, const dvec3& high, const dvec3& origin, const dvec3& dir) {
  double enter = -std::numeric_limits<double>::infinity(), leave = -enter;
  for (int axis = 0; axis < 3; ++axis) {
    if (dir[axis] == 0.0) {
      if (origin[axis] < low[axis] || origin[axis] > high[axis]) return false;
      continue;
    }
    const double to_low = (low[axis] - origin[axis]) / dir[axis];
    const double to_high = (high[axis] - origin[axis]) / dir[axis];
    enter = std::max(enter, std::min(to_low, to_high));
    leave = std::min(leave, std::max(to_low, to_high));
  }
  return enter <= leave;
}

}  // namespace

BruteForceTree::BruteForceTree(const Scene& scene) : BruteForce(scene), order_(splats().size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  nodes_.reserve(order_.size());
  if (!order_.empty()) add_node(0, static_cast<std::uint32_t>(order_.size()));
}

void BruteForceTree::add_node(std::uint32_t begin, std::uint32_t end) {
  const std::size_t self = nodes_.size();
  dvec3 low(std::numeric_limits<double>::infinity()), high = -low, first = low, last = high;
  for (std::uint32_t i = begin; i < end; ++i) {
    const Splat& splat = splats()[order_[i]];
    const double reach = std::sqrt(splat.radius_squared) * (1.0 + WIDER_SHARE) + WIDER;
    low = glm::min(low, splat.center - reach);
    high = glm::max(high, splat.center + reach);
    first = glm::min(first, splat.center);
    last = glm::max(last, splat.center);
  }
  nodes_.push_back({low, high, begin, end, 0});
  if (end - begin > LEAF) {
    const dvec3 size = last - first;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) {
                       return splats()[a].center[axis] < splats()[b].center[axis];
                     });
    add_node(begin, middle);
    add_node(middle, end);
  }
  nodes_[self].next = static_cast<std::uint32_t>(nodes_.size());
}

void BruteForceTree::find_near(const RayQuery& query, std::vector<std::uint32_t>& near) const {
  const dvec3 origin(query.origin);
  const dvec3 dir(query.dir);
  near.clear();
  for (std::uint32_t at = 0; at < nodes_.size();) {
    const Node& node = nodes_[at];
    const bool met = meets(node.low, node.high, origin, dir);
    const bool leaf = node.next == at + 1;
    if (met && leaf) near.insert(near.end(), order_.begin() + node.begin, order_.begin() + node.end);
    at = met ? at + 1 : node.next;
  }
  std::sort(near.begin(), near.end());  // sums of a cluster run in brute force's order
}

}  // namespace splatray::testing
