#include "tests/bench/bvh/bvh.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "engine/base/error.h"
#include "tests/bench/bvh/bvh_spirv.h"

namespace splatray::testing {
namespace {

/// By how much boxes are wider than their discs, lattice units. What a ray's float32 distance to a plane is off moves the
/// point there along the axis by at most 6 roundings, each 2^-24 of its distance from the origin, 2^22: less than 2.
constexpr float WIDENING = 2.0F;
/// bvh.glsl's BVH_DEPTH and BVH_ADDRESS.
constexpr std::uint32_t MOST_DEPTH = 32, MOST_SPLATS = 0xFFFFFF;
constexpr std::size_t BINS = 16;
constexpr std::uint32_t WIDTH = 4;  ///< most children of a node

struct Box {
  glm::vec3 low{std::numeric_limits<float>::max()};
  glm::vec3 high{std::numeric_limits<float>::lowest()};

  void add(const Box& other) {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
  }
  [[nodiscard]] glm::vec3 middle() const { return 0.5F * (low + high); }
  [[nodiscard]] float half_area() const {
    const glm::vec3 size = high - low;
    return size.x * size.y + size.y * size.z + size.z * size.x;
  }
};

/// Of a disc: half extent r sqrt(1 - n^2) on each axis, to integers outwards.
Box box_of(const uvec4& words) {
  const Splat splat = unpack_splat(words);
  const glm::dvec3 across = glm::max(1.0 - splat.normal * splat.normal, 0.0);
  const glm::dvec3 half = glm::sqrt(splat.radius_squared * across) + double(WIDENING);
  return {glm::floor(splat.center - half), glm::ceil(splat.center + half)};
}

/// A node of the binary hierarchy: a single splat where `left` is 0; the right child follows the left.
struct BinaryNode {
  Box box;
  std::uint32_t left = 0;
  std::uint32_t begin = 0, end = 0;
};

struct Split {
  float cost = std::numeric_limits<float>::max();
  int axis = 0;
  float plane = 0.0F;
};

class BinaryBuilder {
 public:
  explicit BinaryBuilder(const std::vector<Box>& boxes) : boxes_(boxes), order_(boxes.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    nodes_.reserve(2 * boxes.size());
    nodes_.push_back(node(0, static_cast<std::uint32_t>(boxes.size())));
    for (std::size_t i = 0; i < nodes_.size(); ++i) divide(i);
  }

  [[nodiscard]] const std::vector<BinaryNode>& nodes() const { return nodes_; }
  [[nodiscard]] const std::vector<std::uint32_t>& order() const { return order_; }

 private:
  [[nodiscard]] BinaryNode node(std::uint32_t begin, std::uint32_t end) const {
    BinaryNode made{{}, 0, begin, end};
    for (std::uint32_t i = begin; i < end; ++i) made.box.add(boxes_[order_[i]]);
    return made;
  }
  [[nodiscard]] Split best_split(const BinaryNode& node, int axis, float low, float high) const;
  [[nodiscard]] Split best_split(const BinaryNode& node) const;
  void divide(std::size_t index);

  const std::vector<Box>& boxes_;
  std::vector<std::uint32_t> order_;
  std::vector<BinaryNode> nodes_;
};

Split BinaryBuilder::best_split(const BinaryNode& node, int axis, float low, float high) const {
  std::array<Box, BINS> bins;
  std::array<std::uint32_t, BINS> counts{};
  const float scale = static_cast<float>(BINS) / (high - low);
  for (std::uint32_t i = node.begin; i < node.end; ++i) {
    const Box& box = boxes_[order_[i]];
    const auto bin = std::min(static_cast<std::size_t>((box.middle()[axis] - low) * scale), BINS - 1);
    bins[bin].add(box);
    ++counts[bin];
  }
  std::array<float, BINS> cost_right{};
  Box right;
  std::uint32_t count = 0;
  for (std::size_t bin = BINS - 1; bin > 0; --bin) {
    right.add(bins[bin]);
    count += counts[bin];
    cost_right[bin] = count > 0 ? right.half_area() * static_cast<float>(count) : 0.0F;
  }
  Split best;
  Box left;
  count = 0;
  for (std::size_t bin = 1; bin < BINS; ++bin) {
    left.add(bins[bin - 1]);
    count += counts[bin - 1];
    if (count == 0 || count == node.end - node.begin) continue;
    const float cost = left.half_area() * static_cast<float>(count) + cost_right[bin];
    if (cost < best.cost) best = {cost, axis, low + static_cast<float>(bin) / scale};
  }
  return best;
}

Split BinaryBuilder::best_split(const BinaryNode& node) const {
  Box middles;
  for (std::uint32_t i = node.begin; i < node.end; ++i) {
    const glm::vec3 middle = boxes_[order_[i]].middle();
    middles.add({middle, middle});
  }
  Split best;
  for (int axis = 0; axis < 3; ++axis) {
    if (middles.low[axis] == middles.high[axis]) continue;
    const Split split = best_split(node, axis, middles.low[axis], middles.high[axis]);
    if (split.cost < best.cost) best = split;
  }
  return best;
}

void BinaryBuilder::divide(std::size_t index) {
  const BinaryNode node_now = nodes_[index];
  const std::uint32_t count = node_now.end - node_now.begin;
  if (count == 1) return;
  const Split split = best_split(node_now);
  const auto begin = order_.begin() + node_now.begin;
  const auto end = order_.begin() + node_now.end;
  auto middle = std::partition(begin, end,
                               [&](std::uint32_t i) { return boxes_[i].middle()[split.axis] < split.plane; });
  if (middle == begin || middle == end) middle = begin + count / 2;  // all in one place
  const auto border = static_cast<std::uint32_t>(middle - order_.begin());
  nodes_[index].left = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back(node(node_now.begin, border));
  nodes_.push_back(node(border, node_now.end));
}

/// A node's corner and exponents.
struct Grid {
  glm::uvec3 corner, exponent{0};

  explicit Grid(const Box& box) : corner(box.low) {
    for (int axis = 0; axis < 3; ++axis)
      while (box.high[axis] - box.low[axis] > static_cast<float>(255U << exponent[axis])) ++exponent[axis];
  }
  [[nodiscard]] glm::uvec3 low(const Box& box) const { return (glm::uvec3(box.low) - corner) >> exponent; }
  [[nodiscard]] glm::uvec3 high(const Box& box) const {
    return (glm::uvec3(box.high) - corner + ((1U << exponent) - 1U)) >> exponent;
  }
};

/// Makes wide nodes from a binary hierarchy.
class WideBuilder {
 public:
  explicit WideBuilder(const BinaryBuilder& binary) : binary_(binary.nodes()), order_(binary.order()) {
    find_least_areas();
    roots_ = {0};
    depths_ = {1};
    for (std::size_t i = 0; i < roots_.size(); ++i) emit(i);
  }

  [[nodiscard]] const std::vector<uvec4>& texels() const { return texels_; }
  [[nodiscard]] const std::vector<std::uint32_t>& splats() const { return splats_; }
  [[nodiscard]] BvhStats stats() const {
    return {0.0, static_cast<std::uint32_t>(roots_.size()), depths_.back()};
  }

 private:
  /// Index k: of all wide nodes below a binary node, where at most k children of one wide node stand for it.
  using LeastAreas = std::array<float, WIDTH + 1>;

  void find_least_areas();
  [[nodiscard]] std::uint32_t best_left(const BinaryNode& node, std::uint32_t count) const;
  void add_children(std::uint32_t node, std::uint32_t count, std::vector<std::uint32_t>& children) const;
  void emit(std::size_t index);

  const std::vector<BinaryNode>& binary_;
  const std::vector<std::uint32_t>& order_;
  std::vector<LeastAreas> least_;      ///< beside binary_
  std::vector<std::uint32_t> roots_;   ///< binary node of each wide node
  std::vector<std::uint32_t> depths_;  ///< beside roots_
  std::vector<uvec4> texels_;
  std::vector<std::uint32_t> splats_;
};

/// How many of `count` children the left side should get, so that the sum of areas is least.
std::uint32_t WideBuilder::best_left(const BinaryNode& node, std::uint32_t count) const {
  const LeastAreas& left = least_[node.left];
  const LeastAreas& right = least_[node.left + 1];
  std::uint32_t best = 1;
  for (std::uint32_t i = 2; i < count; ++i)
    if (left[i] + right[count - i] < left[best] + right[count - best]) best = i;
  return best;
}

void WideBuilder::find_least_areas() {
  least_.resize(binary_.size());
  for (std::size_t n = binary_.size(); n-- > 0;) {
    const BinaryNode& node = binary_[n];
    if (node.left == 0) continue;
    const auto divided = [&](std::uint32_t count) {
      const std::uint32_t left = best_left(node, count);
      return least_[node.left][left] + least_[node.left + 1][count - left];
    };
    least_[n][1] = node.box.half_area() + divided(WIDTH);
    for (std::uint32_t k = 2; k <= WIDTH; ++k) least_[n][k] = std::min(divided(k), least_[n][k - 1]);
  }
}

/// At most `count` children that stand for a binary node.
void WideBuilder::add_children(std::uint32_t node, std::uint32_t count,
                               std::vector<std::uint32_t>& children) const {
  while (count > 1 && least_[node][count] == least_[node][count - 1]) --count;
  const bool whole = count == 1 || binary_[node].left == 0;
  if (whole) return children.push_back(node);
  const std::uint32_t left = best_left(binary_[node], count);
  add_children(binary_[node].left, left, children);
  add_children(binary_[node].left + 1, count - left, children);
}

void WideBuilder::emit(std::size_t index) {
  const BinaryNode& root = binary_[roots_[index]];
  const Grid grid(root.box);
  std::vector<std::uint32_t> children;
  if (root.left == 0) {
    children = {roots_[index]};  // a scene of one splat
  } else {
    const std::uint32_t left = best_left(root, WIDTH);
    add_children(root.left, left, children);
    add_children(root.left + 1, WIDTH - left, children);
  }
  const auto nodes = std::stable_partition(children.begin(), children.end(),
                                           [&](std::uint32_t i) { return binary_[i].left == 0; });
  const auto splat_count = static_cast<std::uint32_t>(nodes - children.begin());

  const std::size_t at = texels_.size();
  texels_.resize(at + 3, uvec4(0xFFFFFFFFU, 0U, 0xFFFFFFFFU, 0U));
  const auto first_node = static_cast<std::uint32_t>(roots_.size()) - splat_count;
  texels_[at] = uvec4(grid.corner | grid.exponent << 21U, first_node);
  uvec4& xy = texels_[at + 1];
  uvec4& z = texels_[at + 2];
  for (std::uint32_t i = 0; i < children.size(); ++i) {
    const Box& box = binary_[children[i]].box;
    const glm::uvec3 low = grid.low(box), high = grid.high(box);
    const std::uint32_t shift = 8 * i;
    xy = (xy & ~(uvec4(255U) << shift)) | uvec4(low.x, high.x, low.y, high.y) << shift;
    z = (z & ~(uvec4(255U) << shift)) | uvec4(low.z, high.z, 0U, 0U) << shift;
  }
  z.z = static_cast<std::uint32_t>(splats_.size());
  z.w = splat_count;
  for (auto child = children.begin(); child != nodes; ++child)
    splats_.push_back(order_[binary_[*child].begin]);
  for (auto child = nodes; child != children.end(); ++child) {
    roots_.push_back(*child);
    depths_.push_back(depths_[index] + 1);
  }
}

}  // namespace

Scene bvh_scene(const Scene& scene, BvhStats& stats) {
  const auto start = std::chrono::steady_clock::now();
  std::vector<Box> boxes;
  boxes.reserve(scene.data_pool.size());
  for (const uvec4& words : scene.data_pool) boxes.push_back(box_of(words));
  const BinaryBuilder binary(boxes);
  const WideBuilder wide(binary);
  stats = wide.stats();
  if (stats.depth > MOST_DEPTH || boxes.size() > MOST_SPLATS)
    throw Error(ExitCode::failed, "found " + std::to_string(boxes.size()) + " splats in a hierarchy " +
                                      std::to_string(stats.depth) + " nodes deep, expected at most " +
                                      std::to_string(MOST_SPLATS) + " and " + std::to_string(MOST_DEPTH));
  stats.build_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

  Scene made = scene;
  made.begin_end.clear();
  made.slab_pool.clear();
  made.reference_pool.clear();
  made.data_pool = listed(scene.data_pool, wide.splats());
  made.color_pool = listed(scene.color_pool, wide.splats());
  made.field_pool = listed(scene.field_pool, wide.splats());
  made.node_pool = {NODE_EMPTY << NODE_TAG_SHIFT | static_cast<std::uint32_t>(made.data_pool.size())};
  made.data_pool.insert(made.data_pool.end(), wide.texels().begin(), wide.texels().end());
  return made;
}

std::span<const std::uint32_t> bvh_code(Program program, PoolAccess access, [[maybe_unused]] bool paged,
                                        Arithmetic arithmetic) {
  const ProgramVariants trace{BVH_TRACE_STORAGE, BVH_TRACE_TEXEL, BVH_TRACE_STORAGE_FLOAT64,
                              BVH_TRACE_TEXEL_FLOAT64};
  const ProgramVariants rays{BVH_RAYS_STORAGE, BVH_RAYS_TEXEL, BVH_RAYS_STORAGE_FLOAT64,
                             BVH_RAYS_TEXEL_FLOAT64};
  assert((program == Program::trace || program == Program::rays) && !paged);
  return (program == Program::trace ? trace : rays).get(access, arithmetic);
}

}  // namespace splatray::testing
