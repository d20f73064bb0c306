/// The top table: where descents begin.
#include <gtest/gtest.h>

#include <glm/glm.hpp>

#include "engine/host/scene.h"

namespace splatray {
namespace {

/// A root whose last child is split twice more, its first child once; the other leaves are empty.
Scene deep_scene() {
  Scene scene;
  const auto inner = [](std::uint32_t first) { return NODE_INNER << NODE_TAG_SHIFT | first; };
  scene.node_pool.assign(33, NODE_EMPTY << NODE_TAG_SHIFT);
  scene.node_pool[0] = inner(1);
  scene.node_pool[1] = inner(9);
  scene.node_pool[8] = inner(17);
  scene.node_pool[24] = inner(25);
  for (std::uint32_t leaf = 0; leaf < 8; ++leaf)
    scene.node_pool[25 + leaf] = NODE_FILLED << NODE_TAG_SHIFT | leaf;
  return scene;
}

/// What a descent of at most `levels` from the root finds at a lattice point.
uvec2 descend(const Scene& scene, const glm::uvec3& point, std::uint32_t levels) {
  std::uint32_t word = scene.node_pool[0];
  std::uint32_t shift = LATTICE_BITS;
  while (word >> NODE_TAG_SHIFT == NODE_INNER && shift > LATTICE_BITS - levels) {
    --shift;
    const glm::uvec3 bit = point >> shift & 1U;
    word = scene.node_pool[(word & NODE_ADDRESS_MASK) + bit.x + 2 * bit.y + 4 * bit.z];
  }
  return {word, shift};
}

TEST(TopTable, HoldsWhatDescentsFind) {
  const Scene scene = deep_scene();
  for (std::uint32_t levels = 0; levels <= 5; ++levels) {
    const std::vector<uvec2> table = top_table(scene, levels);
    const std::uint32_t edge = 1U << levels;
    ASSERT_EQ(table.size(), std::size_t{edge} * edge * edge);
    for (std::uint32_t i = 0; i < table.size(); ++i) {
      const glm::uvec3 cell(i % edge, i / edge % edge, i / edge / edge);
      EXPECT_EQ(table[i], descend(scene, cell << (LATTICE_BITS - levels), levels)) << levels << ' ' << i;
    }
  }
}

TEST(TopTable, HasNoMoreThanAnEntryForTwoSplats) {
  Scene scene;
  const auto levels = [&](std::size_t splats) {
    scene.data_pool.resize(splats);
    return top_levels(scene);
  };
  EXPECT_EQ(levels(0), 0U);
  EXPECT_EQ(levels(15), 0U);
  EXPECT_EQ(levels(16), 1U);
  EXPECT_EQ(levels(2 << 15), 5U);
  EXPECT_EQ(levels((2 << 18) - 1), 5U);
  EXPECT_EQ(levels(5'000'000), TOP_LEVELS_MOST);
}

}  // namespace
}  // namespace splatray
