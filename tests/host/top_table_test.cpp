/// The top table: where descents begin.
#include <gtest/gtest.h>

#include <glm/glm.hpp>

#include "engine/scene/scene.h"
#include "engine/scene/tree.h"

namespace splatray {
namespace {

/// A root whose last child is split twice more, its first child once; the other leaves are empty.
Scene deep_scene() {
  Scene scene;
  const auto inner = [](std::uint32_t first) { return NODE_INNER << NODE_TAG_SHIFT | first; };
  scene.node_pool.edit().assign(33, NODE_EMPTY << NODE_TAG_SHIFT);
  scene.node_pool.edit()[0] = inner(1);
  scene.node_pool.edit()[1] = inner(9);
  scene.node_pool.edit()[8] = inner(17);
  scene.node_pool.edit()[24] = inner(25);
  for (std::uint32_t leaf = 0; leaf < 8; ++leaf)
    scene.node_pool.edit()[25 + leaf] = NODE_FILLED << NODE_TAG_SHIFT | leaf;
  return scene;
}

/// The entry that a descent of at most `levels` from the root makes at a lattice point.
std::uint32_t descend(const Scene& scene, const glm::uvec3& point, std::uint32_t levels) {
  std::uint32_t word = scene.node_pool[0];
  std::uint32_t shift = LATTICE_BITS;
  while (word >> NODE_TAG_SHIFT == NODE_INNER && shift > LATTICE_BITS - levels) {
    --shift;
    const glm::uvec3 bit = point >> shift & 1U;
    word = scene.node_pool[(word & NODE_ADDRESS_MASK) + bit.x + 2 * bit.y + 4 * bit.z];
  }
  if (word >> NODE_TAG_SHIFT == NODE_INNER) return word;
  return word | (LATTICE_BITS - shift) << TOP_LEAF_SHIFT;
}

TEST(TopTable, HoldsWhatDescentsFind) {
  const Scene scene = deep_scene();
  for (std::uint32_t levels = 0; levels <= 5; ++levels) {
    const std::vector<std::uint32_t> table = top_table(scene, levels);
    const std::uint32_t edge = 1U << levels;
    ASSERT_EQ(table.size(), std::size_t{edge} * edge * edge);
    for (std::uint32_t i = 0; i < table.size(); ++i) {
      const glm::uvec3 cell(i % edge, i / edge % edge, i / edge / edge);
      EXPECT_EQ(table[i], descend(scene, cell << (LATTICE_BITS - levels), levels)) << levels << ' ' << i;
    }
  }
}

TEST(TopTable, HasNoMoreEntriesThanSplats) {
  EXPECT_EQ(top_levels(0, 0), 0U);
  EXPECT_EQ(top_levels(7, 1), 0U);
  EXPECT_EQ(top_levels(8, 1), 1U);
  EXPECT_EQ(top_levels(1 << 15, 1000), 5U);
  EXPECT_EQ(top_levels((1 << 18) - 1, 1000), 5U);
  EXPECT_EQ(top_levels(5'000'000, 1000), TOP_LEVELS_MOST);
}

TEST(TopTable, IsOfTheRootAloneWhereLeavesHaveTooLongAddresses) {
  EXPECT_EQ(top_levels(400'000'000, 1U << TOP_LEAF_SHIFT), TOP_LEVELS_MOST);
  EXPECT_EQ(top_levels(400'000'000, (1U << TOP_LEAF_SHIFT) + 1), 0U);
}

}  // namespace
}  // namespace splatray
