/// The boxes of empty leaves hold no filled leaf, or rays would pass by its splats; and they are as wide as they may be.
#include "preprocess/tree/empty_space.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "engine/scene/tree.h"
#include "preprocess/build.h"
#include "tests/all_tests.h"
#include "tests/preprocess/shapes.h"

namespace splatray {
namespace {

constexpr int ROOT_SIZE = 1 << LATTICE_BITS;

struct EmptyLeaf {
  std::uint32_t word;
  OctreeCell cell;
};

std::vector<EmptyLeaf> empty_leaves(const Scene& scene) {
  std::vector<EmptyLeaf> leaves;
  visit_cells(scene, [&](std::uint32_t word, const OctreeCell& cell) {
    if (word >> NODE_TAG_SHIFT == NODE_EMPTY) leaves.push_back({word, cell});
    return true;
  });
  return leaves;
}

/// Whether the box lies in the root and overlaps none of the filled leaves' cells: looked at one by one.
bool is_free(const OctreeBox& box, const std::vector<OctreeCell>& filled) {
  if (glm::any(glm::lessThan(box.low, glm::ivec3(0))) ||
      glm::any(glm::greaterThan(box.high, glm::ivec3(ROOT_SIZE))))
    return false;
  return std::none_of(filled.begin(), filled.end(), [&](const OctreeCell& cell) {
    const glm::ivec3 low(cell.low);
    return glm::all(glm::lessThan(box.low, low + static_cast<int>(cell.size))) &&
           glm::all(glm::greaterThan(box.high, low));
  });
}

/// The word with one step more on a side, or nothing where the side has as many as it may.
std::optional<std::uint32_t> one_step_more(std::uint32_t word, std::uint32_t side) {
  if ((word >> 2 * side & 3U) == EMPTY_STEPS_MOST) return std::nullopt;
  return word + (1U << 2 * side);
}

Scene built(InputObject object, std::uint32_t leaf_size) {
  BuildParams params;
  params.leaf_size = leaf_size;
  BuildStats stats;
  return build_scene(test::input_of(std::move(object)), params, 0, stats);
}

std::vector<Scene> scenes() {
  std::vector<Scene> list;
  list.push_back(built(test::random_sphere(3000, 3), 16));
  list.push_back(built(test::random_sphere(3000, 4), 1));
  InputObject ball = test::random_sphere(2000, 5);
  for (std::size_t i = 0; i < ball.points.size(); ++i) ball.points.position[i] *= double(i) / 2000.0;
  list.push_back(built(std::move(ball), 8));
  return list;
}

TEST(EmptySpace, BoxesHoldNoFilledLeafAndCannotGrow) {
  SPLATRAY_NIGHTLY();
  std::size_t leaves = 0, touched = 0, growing = 0, steps = 0;
  for (const Scene& scene : scenes()) {
    const std::vector<OctreeCell> filled = leaf_cells(scene);
    for (const EmptyLeaf& leaf : empty_leaves(scene)) {
      ++leaves;
      if (!is_free(empty_box(leaf.word, leaf.cell), filled)) ++touched;
      for (std::uint32_t side = 0; side < 6; ++side) {
        const auto wider = one_step_more(leaf.word, side);
        if (wider && is_free(empty_box(*wider, leaf.cell), filled)) ++growing;
        steps += leaf.word >> 2 * side & 3U;
      }
    }
  }
  EXPECT_GT(leaves, 1000U);
  EXPECT_EQ(touched, 0U) << "boxes of " << leaves;
  EXPECT_EQ(growing, 0U) << "boxes of " << leaves;
  EXPECT_GT(steps, 2 * leaves) << "boxes must be wider than their cells";
}

TEST(EmptySpace, WordsAreDecodedSideBySide) {
  const OctreeCell cell{{64, 128, 192}, 16};
  const OctreeBox box = empty_box(NODE_EMPTY << NODE_TAG_SHIFT | 0b11'10'01'00'10'01, cell);
  EXPECT_EQ(box.low, glm::ivec3(64 - 16, 128, 192 - 32));
  EXPECT_EQ(box.high, glm::ivec3(80 + 32, 144 + 16, 208 + 48));
}

TEST(EmptySpace, ARootWithoutLeavesIsLeftAsItIs) {
  Scene scene;
  scene.node_pool = {NODE_EMPTY << NODE_TAG_SHIFT};
  const Progress silent;
  grow_empty_leaves(scene, {"empty space", silent});
  EXPECT_EQ(scene.node_pool, (std::vector<std::uint32_t>{NODE_EMPTY << NODE_TAG_SHIFT}));
}

}  // namespace
}  // namespace splatray
