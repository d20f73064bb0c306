#include "engine/light/light_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace splatray {
namespace {

using glm::dvec3;
using std::numbers::pi;

constexpr int BINS = 12;
/// Larger parts are divided along their longest axis alone, smaller ones in halves: the heuristic takes its time.
constexpr std::size_t LARGE = 1024, SMALL = 16;
/// Cones are widened by this, as float32's cosines of directions beside them may be.
constexpr double CONE_SLACK = 1e-3;

/// The directions within an angle of an axis, or of it and the opposite one.
struct Cone {
  dvec3 axis{0.0, 0.0, 1.0};
  double angle = 0.0;  ///< of what shines straight ahead, [0, pi]
  double edge = 0.0;   ///< how far beside that anything shines, [0, pi]
  bool two_sided = false;
};

/// A box of centres, with what is below it.
struct Bounds {
  dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
  Cone cone;
  double power = 0.0;
  bool empty = true;
};

/// A leaf to be.
struct Item {
  dvec3 center;
  double radius;
  Cone cone;
  double power;
  std::uint32_t content;
};
using Items = std::span<Item>;

/// Holds both.
Cone united(const Cone& a, Cone b) {
  const bool two_sided = a.two_sided || b.two_sided;
  if (two_sided && glm::dot(a.axis, b.axis) < 0.0) b.axis = -b.axis;
  const Cone& wide = a.angle >= b.angle ? a : b;
  const Cone& narrow = a.angle >= b.angle ? b : a;
  Cone both = wide;
  both.two_sided = two_sided;
  both.edge = std::max(a.edge, b.edge);
  const double between = std::acos(std::clamp(glm::dot(wide.axis, narrow.axis), -1.0, 1.0));
  if (between + narrow.angle <= wide.angle) return both;
  const double angle = 0.5 * (wide.angle + between + narrow.angle);
  const dvec3 across = glm::cross(wide.axis, narrow.axis);
  const double length = glm::length(across);
  both.angle = std::min(angle, pi);
  if (angle >= pi || length < 1e-9) {
    both.angle = pi;
    return both;
  }
  // The wider one's axis, turned towards the other's.
  const double turn = angle - wide.angle;
  both.axis = wide.axis * std::cos(turn) + glm::cross(across / length, wide.axis) * std::sin(turn);
  return both;
}

void add(Bounds& bounds, const dvec3& low, const dvec3& high, const Cone& cone, double power) {
  bounds.low = glm::min(bounds.low, low);
  bounds.high = glm::max(bounds.high, high);
  bounds.cone = bounds.empty ? cone : united(bounds.cone, cone);
  bounds.power += power;
  bounds.empty = false;
}
void add(Bounds& bounds, const Item& item) {
  add(bounds, item.center - item.radius, item.center + item.radius, item.cone, item.power);
}
void add(Bounds& bounds, const Bounds& other) {
  if (!other.empty) add(bounds, other.low, other.high, other.cone, other.power);
}

/// The heuristic's measure of directions, over 2 pi.
double orientation(const Cone& cone) {
  const double reach = std::min(cone.angle + cone.edge, pi);
  const double sine = std::sin(cone.angle), cosine = std::cos(cone.angle);
  return 2.0 * pi * (1.0 - cosine) +
         0.5 * pi *
             (2.0 * reach * sine - std::cos(cone.angle - 2.0 * reach) - 2.0 * cone.angle * sine + cosine);
}

/// The heuristic's cost of a part, but for the shape of the whole.
double cost(const Bounds& bounds) {
  if (bounds.empty) return 0.0;
  const dvec3 size = bounds.high - bounds.low;
  return bounds.power * orientation(bounds.cone) * glm::dot(size, size);
}

int bin_of(const Item& item, int axis, double low, double width) {
  return std::clamp(static_cast<int>(BINS * (item.center[axis] - low) / width), 0, BINS - 1);
}

/// Divides items in two parts, none of them empty, and returns the size of the first.
std::size_t divide(Items items) {
  dvec3 low = items.front().center, high = low;
  for (const Item& item : items) {
    low = glm::min(low, item.center);
    high = glm::max(high, item.center);
  }
  const dvec3 size = high - low;
  const int longest_axis = size.x >= std::max(size.y, size.z) ? 0 : (size.y >= size.z ? 1 : 2);
  const double longest = size[longest_axis];
  if (items.size() <= SMALL) {
    const auto middle = items.begin() + static_cast<std::ptrdiff_t>(items.size() / 2);
    std::nth_element(items.begin(), middle, items.end(), [longest_axis](const Item& a, const Item& b) {
      return a.center[longest_axis] < b.center[longest_axis];
    });
    return items.size() / 2;
  }
  double least = std::numeric_limits<double>::infinity();
  int axis = 0, first_bins = 0;
  for (int i = 0; i < 3; ++i) {
    if (size[i] <= 0.0 || (items.size() > LARGE && i != longest_axis)) continue;
    std::array<Bounds, BINS> bins;
    for (const Item& item : items)
      add(bins[static_cast<std::size_t>(bin_of(item, i, low[i], size[i]))], item);
    std::array<double, BINS> behind{};  // the cost of all bins from this one on
    Bounds sum;
    for (std::size_t j = BINS - 1; j > 0; --j) {
      add(sum, bins[j]);
      behind[j] = cost(sum);
    }
    sum = {};
    for (std::size_t j = 1; j < BINS; ++j) {
      add(sum, bins[j - 1]);
      const double split = (cost(sum) + behind[j]) * longest / size[i];
      if (split < least) {
        least = split;
        axis = i;
        first_bins = static_cast<int>(j);
      }
    }
  }
  const auto middle = std::partition(items.begin(), items.end(), [&](const Item& item) {
    return first_bins > 0 && bin_of(item, axis, low[axis], size[axis]) < first_bins;
  });
  const auto first = static_cast<std::size_t>(middle - items.begin());
  return first == 0 || first == items.size() ? items.size() / 2 : first;
}

LightNode node_of(const Bounds& bounds, const dvec3& center, double radius, std::uint32_t content) {
  LightNode node{};
  node.center = vec3(center);
  node.radius = static_cast<float>(radius);
  node.axis = vec3(bounds.cone.axis);
  node.cos_axis = static_cast<float>(std::cos(std::min(bounds.cone.angle + CONE_SLACK, pi)));
  node.power = static_cast<float>(bounds.power);
  node.cos_edge = static_cast<float>(std::cos(bounds.cone.edge)) - 1e-6F;
  node.content = content | (bounds.cone.two_sided ? LIGHT_NODE_TWO_SIDED : 0U);
  return node;
}

class Builder {
 public:
  explicit Builder(LightTree& tree) : tree_(tree) {}

  /// Appends the nodes of items, of which there is one at least.
  void add_part(Items items) {
    const std::size_t index = tree_.nodes.size();
    tree_.nodes.push_back(summary(items));
    if (items.size() > 1) {
      const std::size_t first = divide(items);
      add_part(items.first(first));
      add_part(items.subspan(first));
    }
    tree_.nodes[index].skip = static_cast<std::uint32_t>(tree_.nodes.size());
  }

  /// Appends the nodes of several parts, those that are not empty.
  void add_parts(std::span<const Items> parts) {
    while (!parts.empty() && parts.front().empty()) parts = parts.subspan(1);
    if (parts.empty()) return;
    std::vector<Item> all;
    for (const Items& part : parts) all.insert(all.end(), part.begin(), part.end());
    const std::size_t index = tree_.nodes.size();
    const bool alone = all.size() == parts.front().size();
    if (!alone) tree_.nodes.push_back(summary(all));
    const std::size_t begin = tree_.nodes.size();
    add_part(parts.front());
    if (parts.size() == 2) {
      tree_.sized_begin = static_cast<std::uint32_t>(begin);
      tree_.sized_end = static_cast<std::uint32_t>(tree_.nodes.size());
    }
    if (!alone) add_parts(parts.subspan(1));
    tree_.nodes[index].skip = static_cast<std::uint32_t>(tree_.nodes.size());
  }

 private:
  static LightNode summary(Items items) {
    Bounds bounds;
    bool distant = true;
    for (const Item& item : items) {
      add(bounds, item);
      distant = distant && (item.content & LIGHT_NODE_DISTANT) != 0;
    }
    const bool leaf = items.size() == 1;
    dvec3 center = leaf ? items.front().center : 0.5 * (bounds.low + bounds.high);
    if (distant) center = glm::length(center) > 1e-6 ? glm::normalize(center) : dvec3(0.0, 1.0, 0.0);
    double radius = 0.0;
    for (const Item& item : items)
      radius = std::max(radius, glm::distance(center, item.center) + item.radius);
    const std::uint32_t content = leaf ? items.front().content : (distant ? LIGHT_NODE_DISTANT : 0U);
    return node_of(bounds, center, radius * (leaf ? 1.0 : 1.00001), content);
  }

  LightTree& tree_;
};

double mean(const vec3& color) { return (double(color.x) + double(color.y) + double(color.z)) / 3.0; }

Item item_of(const Light& light, std::uint32_t index) {
  const bool directional = light.kind == LIGHT_DIRECTIONAL;
  Item item{dvec3(light.position), double(light.size), {}, mean(light.power), LIGHT_NODE_LEAF | index};
  item.cone.angle = pi;
  if (directional) {
    item.radius = light.size < 0.5 * pi ? std::sin(double(light.size)) : 1.0;
    item.content |= LIGHT_NODE_DISTANT;
  } else if (is_flat(light.kind)) {
    const dvec3 across = glm::cross(dvec3(light.edge_u), dvec3(light.edge_v));
    item.radius = std::hypot(glm::length(light.edge_u), glm::length(light.edge_v));
    item.cone = {glm::normalize(across), 0.0, 0.5 * pi};
    item.power *= flat_area(light.kind) * glm::length(across);
  } else if (light.spot_scale > 0.0F) {
    item.cone = {dvec3(light.spot_axis), std::acos(std::clamp(double(light.spot_cosine), -1.0, 1.0)), 0.0};
  }
  return item;
}

Item item_of(const Emitter& emitter, std::uint32_t index, const std::vector<bool>& two_sided) {
  const Splat splat = emitter.splat();
  const Cone cone{glm::normalize(dvec3(splat.normal)), 0.0, 0.5 * pi, two_sided[splat.object]};
  return {dvec3(splat.center), std::sqrt(splat.radius_squared), cone, double(emitter.power),
          LIGHT_NODE_LEAF | LIGHT_NODE_EMITTER | index};
}

}  // namespace

bool is_met(const Light& light) { return light.kind != LIGHT_DIRECTIONAL && light.size > 0.0F; }

LightTree light_tree(std::span<Light> lights, const Emitters& emitters, const std::vector<bool>& two_sided) {
  std::vector<Item> distant, sized, others;
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    const bool directional = lights[i].kind == LIGHT_DIRECTIONAL;
    (directional ? distant : (is_met(lights[i]) ? sized : others)).push_back(item_of(lights[i], i));
  }
  const std::size_t count = emitters ? emitters->size() : 0;
  others.reserve(others.size() + count);
  for (std::uint32_t i = 0; i < count; ++i) others.push_back(item_of((*emitters)[i], i, two_sided));
  LightTree tree;
  tree.nodes.reserve(2 * (lights.size() + count));
  const std::array<Items, 3> parts{distant, sized, others};
  Builder(tree).add_parts(parts);
  for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
    const std::uint32_t content = tree.nodes[i].content;
    const bool leaf = (content & LIGHT_NODE_LEAF) != 0;
    if (leaf && (content & LIGHT_NODE_EMITTER) == 0) lights[content & LIGHT_NODE_INDEX].node = i;
  }
  return tree;
}

}  // namespace splatray
