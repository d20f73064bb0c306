/// The octree: full, minimal, capped in depth, with every centre in its own leaf.
#include "preprocess/tree/octree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "engine/scene/splat.h"
#include "preprocess/base/morton.h"

namespace splatray {
namespace {

/// Ordered splats at the given lattice points, all different by their normals.
SplatList splats_at(const std::vector<glm::uvec3>& centers, double radius = 10.0) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> gauss;
  SplatList splats;
  for (const glm::uvec3& center : centers) {
    const glm::dvec3 normal = glm::normalize(glm::dvec3(gauss(random), gauss(random), gauss(random)));
    splats.words.push_back(pack_splat({glm::dvec3(center), normal, radius * radius, 0}));
    splats.key.push_back(morton_key(center));
  }
  order_splats(splats, 1U << 20);
  return splats;
}

std::vector<glm::uvec3> random_centers(std::size_t count, std::uint32_t extent) {
  std::mt19937_64 random(2);
  std::uniform_int_distribution<std::uint32_t> coordinate(0, extent - 1);
  std::vector<glm::uvec3> centers;
  for (std::size_t i = 0; i < count; ++i)
    centers.emplace_back(coordinate(random), coordinate(random), coordinate(random));
  return centers;
}

/// Walks a tree in Z-order and checks every node against its definition.
class Checker {
 public:
  Checker(const Octree& tree, const SplatList& splats, std::uint32_t leaf_size)
      : tree_(tree), splats_(splats), leaf_size_(leaf_size) {}

  void check() {
    const std::uint32_t centers = check_node(0, 0, 0);
    EXPECT_EQ(centers, splats_.size());
    EXPECT_EQ(nodes_, tree_.node_pool.size()) << "every node is reached once";
    EXPECT_EQ(leaves_, tree_.leaves.size());
  }

  [[nodiscard]] std::size_t crowded_leaves() const { return crowded_leaves_; }
  [[nodiscard]] std::size_t divided_like_crowded() const { return divided_like_crowded_; }

 private:
  /// Whether a node that is too full, but not by much, has splats too large for its children.
  bool is_crowded(std::size_t begin, std::size_t end, std::uint32_t level) const {
    double sum = 0.0;
    for (std::size_t i = begin; i < end; ++i) sum += unpack_splat(splats_.words[i]).radius_squared;
    const double child = double(1U << (LATTICE_BITS - level - 1));
    return is_little_too_full(end - begin) && sum > 0.36 * 0.36 * child * child * double(end - begin);
  }

  bool is_little_too_full(std::size_t centers) const {
    return centers > leaf_size_ && 4 * centers <= 7 * std::size_t(leaf_size_);
  }

  /// Returns the number of centres in the node.
  std::uint32_t check_node(std::uint32_t node, std::uint64_t key, std::uint32_t level) {
    ++nodes_;
    const std::uint32_t tag = tree_.node_pool[node] >> NODE_TAG_SHIFT;
    const std::uint32_t address = tree_.node_pool[node] & NODE_ADDRESS_MASK;
    if (tag != NODE_INNER) return check_leaf(tree_.leaves[address], address, tag, node, key, level);
    EXPECT_LE(address + 8, tree_.node_pool.size());
    EXPECT_EQ(address % 8, 1U) << "children are blocks of eight after the root";
    std::uint32_t centers = 0;
    for (std::uint32_t child = 0; child < 8; ++child) {
      centers += check_node(address + child, key + (std::uint64_t{child} << 3 * (LATTICE_BITS - level - 1)),
                            level + 1);
    }
    EXPECT_GT(centers, leaf_size_) << "only what is too full is divided";
    EXPECT_FALSE(is_crowded(centers_ - centers, centers_, level)) << "but not among large splats";
    divided_like_crowded_ += is_little_too_full(centers) ? 1 : 0;
    return centers;
  }

  std::uint32_t check_leaf(const Leaf& leaf, std::uint32_t address, std::uint32_t tag, std::uint32_t node,
                           std::uint64_t key, std::uint32_t level) {
    EXPECT_EQ(address, leaves_++) << "leaves are in Z-order";
    EXPECT_EQ(leaf.node, node);
    EXPECT_EQ(leaf.key, key);
    EXPECT_EQ(leaf.level, level);
    EXPECT_LE(level, MAX_DEPTH);
    const std::uint32_t centers = leaf.end - leaf.begin;
    EXPECT_EQ(tag, centers > 0 ? NODE_FILLED : NODE_EMPTY);
    const bool crowded = is_crowded(leaf.begin, leaf.end, level);
    EXPECT_TRUE(centers <= leaf_size_ || level == MAX_DEPTH || crowded);
    crowded_leaves_ += crowded ? 1 : 0;
    EXPECT_EQ(leaf.begin, centers_);
    centers_ += centers;
    const glm::uvec3 low = morton_point(key);
    for (std::uint32_t i = leaf.begin; i < leaf.end; ++i) {
      const glm::uvec3 center(unpack_splat(splats_.words[i]).center);
      EXPECT_TRUE(glm::all(glm::lessThan(center - low, glm::uvec3(leaf.cell_size()))))
          << "centre outside its leaf";
    }
    return centers;
  }

  const Octree& tree_;
  const SplatList& splats_;
  std::uint32_t leaf_size_;
  std::size_t nodes_ = 0;
  std::size_t leaves_ = 0;
  std::size_t centers_ = 0;  ///< in the leaves so far
  std::size_t crowded_leaves_ = 0;
  std::size_t divided_like_crowded_ = 0;  ///< inner nodes as full as crowded leaves
};

void check_tree(const std::vector<glm::uvec3>& centers, std::uint32_t leaf_size) {
  const SplatList splats = splats_at(centers);
  Checker(build_octree(splats, leaf_size), splats, leaf_size).check();
}

TEST(Octree, RandomCentres) {
  for (const std::uint32_t leaf_size : {1U, 4U, 10U, 100U})
    check_tree(random_centers(5000, 1U << LATTICE_BITS), leaf_size);
}

TEST(Octree, CrowdedCellsOfLargeSplatsStayWhole) {
  std::size_t crowded = 0;
  std::size_t divided = 0;
  for (const std::uint32_t leaf_size : {1U, 4U, 10U, 16U, 100U}) {
    const SplatList splats = splats_at(random_centers(5000, 1U << LATTICE_BITS), 30000.0);
    const Octree tree = build_octree(splats, leaf_size);
    Checker checker(tree, splats, leaf_size);
    checker.check();
    crowded += checker.crowded_leaves();
    divided += checker.divided_like_crowded();
  }
  EXPECT_GT(crowded, 0U);
  EXPECT_GT(divided, 0U);
}

TEST(Octree, FewCentresAreOneLeaf) {
  const SplatList splats = splats_at(random_centers(10, 1U << LATTICE_BITS));
  const Octree tree = build_octree(splats, 10);
  EXPECT_EQ(tree.node_pool, std::vector<std::uint32_t>{NODE_FILLED << NODE_TAG_SHIFT});
}

TEST(Octree, CoincidentCentresEndAtTheDepthCap) {
  const std::vector<glm::uvec3> centers(10000, glm::uvec3(1234567, 7654, 2097151));
  check_tree(centers, 10);
  const Octree tree = build_octree(splats_at(centers), 10);
  EXPECT_EQ(tree.node_pool.size(), 1U + 8U * MAX_DEPTH);
}

TEST(Octree, CentresOneStepApartEndAtTheDepthCap) { check_tree(random_centers(10000, 32), 10); }

TEST(Octree, CornersOfTheRoot) {
  std::vector<glm::uvec3> corners;
  for (std::uint32_t i = 0; i < 8; ++i)
    corners.push_back(glm::uvec3(i & 1U, i >> 1 & 1U, i >> 2) * 0x1FFFFFU);
  check_tree(corners, 1);
}

TEST(SplatOrder, CopiesBeyondTheLimitAreDropped) {
  SplatList splats;
  const uvec4 words = pack_splat({glm::dvec3(5.0), {0.0, 0.0, 1.0}, 100.0, 0});
  const uvec4 other = pack_splat({glm::dvec3(5.0), {0.0, 1.0, 0.0}, 100.0, 0});
  for (int i = 0; i < 30; ++i) {
    splats.words.push_back(i % 3 == 0 ? other : words);
    splats.key.push_back(morton_key(glm::uvec3(5)));
  }
  EXPECT_EQ(order_splats(splats, 4), 22U);
  EXPECT_EQ(splats.size(), 8U);
  EXPECT_EQ(std::count(splats.words.begin(), splats.words.end(), other), 4);
}

TEST(Morton, RoundTripAndOrderOfChildren) {
  for (const glm::uvec3& point : random_centers(1000, 1U << LATTICE_BITS)) {
    EXPECT_EQ(morton_point(morton_key(point)), point);
  }
  EXPECT_EQ(morton_key({1, 0, 0}), 1U);
  EXPECT_EQ(morton_key({0, 1, 0}), 2U);
  EXPECT_EQ(morton_key({0, 0, 1}), 4U);
  EXPECT_EQ(morton_key(glm::uvec3(0x1FFFFF)), 0x7FFFFFFFFFFFFFFFULL);
}

}  // namespace
}  // namespace splatray
