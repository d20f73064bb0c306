#include "engine/scene/scene_check.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/format/tiny_scene.h"

namespace splatray {
namespace {

constexpr std::uint32_t filled(std::uint32_t address) { return NODE_FILLED << NODE_TAG_SHIFT | address; }
constexpr std::uint32_t inner(std::uint32_t address) { return NODE_INNER << NODE_TAG_SHIFT | address; }

/// What is found in the tiny scene after a change; empty = nothing.
template <typename Change>
std::string found_after(Change change) {
  Scene scene = tiny_scene();
  change(scene);
  const auto defect = find_scene_defect(scene);
  return defect ? defect->found : "";
}

TEST(SceneCheck, TinySceneIsSound) {
  EXPECT_EQ(found_after([](Scene&) {}), "");
}

TEST(SceneCheck, FindsBadTransforms) {
  EXPECT_NE(found_after([](Scene& s) { s.root.unit_world = 0.0; }), "");
  EXPECT_NE(found_after([](Scene& s) { s.root.unit_world = INFINITY; }), "");
  EXPECT_NE(found_after([](Scene& s) { s.root.origin_world.y = NAN; }), "");
  EXPECT_NE(found_after([](Scene& s) { s.up = glm::dvec3(0.0); }), "");
  EXPECT_NE(found_after([](Scene& s) { s.bounds_min_world.x = 9.0; }), "");
  EXPECT_NE(found_after([](Scene& s) { s.surface_area_world = -1.0; }), "");
  EXPECT_NE(found_after([](Scene& s) { s.build.leaf_size = 0; }), "");
  EXPECT_NE(found_after([](Scene& s) { s.build.insertion = Insertion{3}; }), "");
}

TEST(SceneCheck, FindsBadNodes) {
  EXPECT_EQ(found_after([](Scene& s) { s.node_pool[0] = inner(2); }), "node 0 with children at 2");
  EXPECT_EQ(found_after([](Scene& s) { s.node_pool[1] = inner(0); }), "node 1 with children at 0");
  EXPECT_EQ(found_after([](Scene& s) { s.node_pool[8] = inner(1); }),
            "node 8 with children that have another parent");
  EXPECT_EQ(found_after([](Scene& s) { s.node_pool[8] = filled(2); }).substr(0, 6), "leaf 8");
  EXPECT_EQ(found_after([](Scene& s) { s.node_pool[8] = 0xC0000000U; }).substr(0, 6), "leaf 8");
  EXPECT_EQ(found_after([](Scene& s) { s.node_pool[2] |= EMPTY_STEPS_MASK + 1U; }).substr(0, 6), "leaf 2");
  EXPECT_EQ(found_after([](Scene& s) { s.node_pool.push_back(filled(0)); }), "1 node words outside the tree");
  EXPECT_EQ(found_after([](Scene& s) { s.node_pool.clear(); }), "no octree");
}

TEST(SceneCheck, FindsTooDeepTrees) {
  const auto deepen = [](Scene& scene, std::uint32_t levels) {
    for (std::uint32_t level = 1; level < levels; ++level) {
      const auto end = static_cast<std::uint32_t>(scene.node_pool.size());
      scene.node_pool.back() = inner(end);
      scene.node_pool.resize(end + 8, NODE_EMPTY << NODE_TAG_SHIFT);
    }
  };
  EXPECT_EQ(found_after([&](Scene& s) { deepen(s, MAX_DEPTH); }), "");
  EXPECT_NE(found_after([&](Scene& s) { deepen(s, MAX_DEPTH + 1); }), "");
}

TEST(SceneCheck, FindsBadBeginEnd) {
  EXPECT_NE(found_after([](Scene& s) { s.begin_end = {0, 2, 4}; }), "");
  EXPECT_NE(found_after([](Scene& s) { s.begin_end = {1, 2, 5}; }), "");
  EXPECT_NE(found_after([](Scene& s) { s.begin_end = {0, 5, 5}; }), "");
  EXPECT_NE(found_after([](Scene& s) { s.begin_end = {0, 6, 5}; }), "");
  EXPECT_EQ(found_after([](Scene& s) { s.reference_pool[2] = 4; }), "a reference to splat 4");
}

TEST(SceneCheck, FindsBadSplats) {
  EXPECT_EQ(found_after([](Scene& s) { s.data_pool[2].w |= 2U; }), "splat 2 of object 2");
  EXPECT_EQ(found_after([](Scene& s) { s.data_pool[2].y |= 1U << 21U; }),
            "splat 2 with its reserved bit set");
  EXPECT_EQ(found_after([](Scene& s) { s.data_pool[2].z |= 0xFFFFU; }), "splat 2 with an invalid normal");
  EXPECT_EQ(found_after([](Scene& s) { s.data_pool[2].z |= 0xFFFF0000U; }), "splat 2 with an invalid normal");
  for (const std::uint32_t bits :
       {0xFFFF0000U, 0xFE000000U, 0xC0000000U})  // NaN, infinity, larger than the root
    EXPECT_EQ(found_after([&](Scene& s) { s.data_pool[2].w |= bits; }),
              "splat 2 with a radius that is not finite or exceeds the root");
}

TEST(SceneCheck, FindsBadSizesAndLooks) {
  EXPECT_EQ(found_after([](Scene& s) { s.slab_pool.pop_back(); }), "1 slabs");
  EXPECT_NE(found_after([](Scene& s) { s.color_pool.pop_back(); }), "");
  EXPECT_NE(found_after([](Scene& s) { s.field_pool.pop_back(); }), "");
  EXPECT_NE(found_after([](Scene& s) { s.object_names.pop_back(); }), "");
  EXPECT_EQ(found_after([](Scene& s) {
              s.data_pool.resize(6, s.data_pool[0]), s.color_pool.clear(), s.field_pool.clear();
            }),
            "6 splats in 5 references");
  EXPECT_NE(found_after([](Scene& s) { s.materials[1].diffuse.x = NAN; }), "");
  EXPECT_NE(found_after([](Scene& s) { s.materials[0].ior = 0.0F; }), "");
  EXPECT_NE(found_after([](Scene& s) { s.materials[0].mask_bit = 32; }), "");
  EXPECT_NE(found_after([](Scene& s) { s.lights[0].kind = 2; }), "");
  EXPECT_NE(found_after([](Scene& s) {
              s.lights[0] = {LIGHT_DIRECTIONAL, glm::dvec3(0.0), vec3(1.0F)};
            }),
            "");
  EXPECT_NE(found_after([](Scene& s) { s.camera->fov_y_deg = NAN; }), "");
}

}  // namespace
}  // namespace splatray
