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
  EXPECT_EQ(found_after([](Scene& s) { s.node_pool.edit()[0] = inner(2); }), "node 0 with children at 2");
  EXPECT_EQ(found_after([](Scene& s) { s.node_pool.edit()[1] = inner(0); }), "node 1 with children at 0");
  EXPECT_EQ(found_after([](Scene& s) { s.node_pool.edit()[8] = inner(1); }),
            "node 8 with children that have another parent");
  EXPECT_EQ(found_after([](Scene& s) { s.node_pool.edit()[8] = filled(2); }).substr(0, 6), "leaf 8");
  EXPECT_EQ(found_after([](Scene& s) { s.node_pool.edit()[8] = 0xC0000000U; }).substr(0, 6), "leaf 8");
  EXPECT_EQ(found_after([](Scene& s) { s.node_pool.edit()[2] |= EMPTY_STEPS_MASK + 1U; }).substr(0, 6),
            "leaf 2");
  EXPECT_EQ(found_after([](Scene& s) { s.node_pool.edit().push_back(filled(0)); }),
            "1 node words outside the tree");
  EXPECT_EQ(found_after([](Scene& s) { s.node_pool.edit().clear(); }), "no octree");
}

TEST(SceneCheck, FindsLeavesWithoutANodeOfTheirOwn) {
  EXPECT_EQ(found_after([](Scene& s) { s.node_pool.edit()[2] = filled(0); }),
            "node 2 that shares filled leaf 0");
  EXPECT_EQ(found_after([](Scene& s) { s.node_pool.edit()[8] = filled(0); }),
            "node 8 that shares filled leaf 0");
  EXPECT_EQ(found_after([](Scene& s) { s.node_pool.edit()[8] = NODE_EMPTY << NODE_TAG_SHIFT; }),
            "1 filled leaves that are not in the tree");
}

/// Steps of an empty leaf's box: on side 0 -x, 1 +x, 2 -y, 3 +y, 4 -z, 5 +z.
constexpr std::uint32_t empty(std::uint32_t side, std::uint32_t steps) {
  return NODE_EMPTY << NODE_TAG_SHIFT | steps << 2 * side;
}

/// In the tiny scene children 0 (node 1) and 7 (node 8) are filled.
TEST(SceneCheck, FindsEmptySpaceOverFilledLeaves) {
  EXPECT_EQ(found_after([](Scene& s) { s.node_pool.edit()[2] = empty(3, 1); }), "") << "child 1 over child 3";
  const auto over = [](std::size_t node) {
    return "empty leaf " + std::to_string(node) + " whose box reaches over a filled leaf or out of the root";
  };
  EXPECT_EQ(found_after([](Scene& s) { s.node_pool.edit()[2] = empty(0, 1); }), over(2))
      << "child 1 over child 0";
  EXPECT_EQ(found_after([](Scene& s) { s.node_pool.edit()[7] = empty(1, 1); }), over(7))
      << "child 6 over child 7";
  EXPECT_EQ(found_after([](Scene& s) { s.node_pool.edit()[4] = empty(5, 1); }), over(4))
      << "child 3 over child 7";
  EXPECT_EQ(found_after([](Scene& s) { s.node_pool.edit()[2] = empty(1, 1); }), over(2))
      << "child 1 out of the root";
  EXPECT_EQ(found_after([](Scene& s) { s.node_pool.edit()[2] = empty(3, 2); }), over(2))
      << "child 1 out of the root";
}

TEST(SceneCheck, FindsEmptySpaceOverDeeperFilledLeaves) {
  const auto deepen = [](Scene& s, std::uint32_t filled_child, std::uint32_t word) {
    s.node_pool.edit()[8] = inner(9);
    s.node_pool.edit().resize(17, NODE_EMPTY << NODE_TAG_SHIFT);
    s.node_pool.edit()[9 + filled_child] = filled(1);
    s.node_pool.edit()[7] = word;
  };
  EXPECT_NE(found_after([&](Scene& s) { deepen(s, 6, empty(1, 1)); }), "");
  EXPECT_NE(found_after([&](Scene& s) { deepen(s, 0, empty(1, 1)); }), "");
  const auto below = [&](std::uint32_t child, std::uint32_t word) {
    return found_after([&](Scene& s) { deepen(s, 7, empty(0, 0)), s.node_pool.edit()[9 + child] = word; });
  };
  EXPECT_EQ(below(6, empty(0, 1)), "") << "into the neighbour of its parent";
  EXPECT_NE(below(6, empty(1, 1)), "") << "over its filled sibling";
  EXPECT_EQ(below(0, empty(0, 2)), "");
  EXPECT_NE(below(0, empty(0, 3)), "") << "out of the root";
}

TEST(SceneCheck, FindsBadSlabs) {
  EXPECT_EQ(found_after([](Scene& s) { s.slab_pool.edit()[1] |= 63U << 5U; }), "slab 1 with an invalid axis");
  EXPECT_EQ(
      found_after([](Scene& s) { s.slab_pool.edit()[1] = (SLAB_FULL & 0xFFFFFFU) | 1U << 24U | 2U << 28U; }),
      "");
  EXPECT_EQ(found_after([](Scene& s) { s.slab_pool.edit()[1] = (SLAB_FULL & 0xFFFFFFU) | 2U << 28U; }),
            "slab 1 whose halves leave out 1 of the leaf's splats");
}

TEST(SceneCheck, FindsTooDeepTrees) {
  const auto deepen = [](Scene& scene, std::uint32_t levels) {
    for (std::uint32_t level = 1; level < levels; ++level) {
      const auto end = static_cast<std::uint32_t>(scene.node_pool.size());
      scene.node_pool.edit().back() = inner(end);
      scene.node_pool.edit().resize(end + 7, NODE_EMPTY << NODE_TAG_SHIFT);
      scene.node_pool.edit().push_back(filled(1));
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
  EXPECT_EQ(found_after([](Scene& s) { s.reference_pool.edit()[2] = 4; }), "a reference to splat 4");
}

TEST(SceneCheck, FindsBadSplats) {
  EXPECT_EQ(found_after([](Scene& s) { s.data_pool.edit()[2].w |= 2U; }), "splat 2 of object 2");
  EXPECT_EQ(found_after([](Scene& s) { s.data_pool.edit()[2].y |= 1U << 21U; }),
            "splat 2 with its reserved bit set");
  EXPECT_EQ(found_after([](Scene& s) { s.data_pool.edit()[2].z |= 0xFFFFU; }),
            "splat 2 with an invalid normal");
  EXPECT_EQ(found_after([](Scene& s) { s.data_pool.edit()[2].z |= 0xFFFF0000U; }),
            "splat 2 with an invalid normal");
  for (const std::uint32_t bits :
       {0xFFFF0000U, 0xFE000000U, 0xC0000000U})  // NaN, infinity, larger than the root
    EXPECT_EQ(found_after([&](Scene& s) { s.data_pool.edit()[2].w |= bits; }),
              "splat 2 with a radius that is not finite or exceeds the root");
}

TEST(SceneCheck, FindsBadSizesAndLooks) {
  EXPECT_EQ(found_after([](Scene& s) { s.slab_pool.edit().pop_back(); }), "1 slabs");
  EXPECT_NE(found_after([](Scene& s) { s.color_pool.edit().pop_back(); }), "");
  EXPECT_NE(found_after([](Scene& s) { s.field_pool.edit().pop_back(); }), "");
  EXPECT_NE(found_after([](Scene& s) { s.object_names.pop_back(); }), "");
  EXPECT_EQ(found_after([](Scene& s) {
              s.data_pool.edit().resize(6, s.data_pool[0]), s.color_pool.edit().clear(),
                  s.field_pool.edit().clear(), s.clip_pool.edit().clear();
            }),
            "6 splats in 5 references");
  EXPECT_NE(found_after([](Scene& s) { s.camera->fov_y_deg = NAN; }), "");
  EXPECT_NE(found_after([](Scene& s) { s.camera->fov_y_deg = 180.0; }), "");
  EXPECT_NE(found_after([](Scene& s) { s.camera->ortho_height = -1.0; }), "");
}

TEST(SceneCheck, FindsMaterialsOutOfRange) {
  const auto found = [](auto member, auto value) {
    return found_after([=](Scene& s) { s.materials[1].*member = value; });
  };
  const auto found_in_phong = [](auto member, auto value) {
    return found_after([=](Scene& s) { s.materials[1].phong.*member = value; });
  };
  for (const float wrong : {-1e30F, -0.01F, 1.01F, 1e30F, INFINITY, NAN}) {
    EXPECT_EQ(found_in_phong(&Phong::mirror, wrong), "material 1 with a mirror out of range");
    EXPECT_EQ(found_in_phong(&Phong::specular, wrong), "material 1 with a specular reflectance out of range");
    EXPECT_EQ(found_in_phong(&Phong::tint, vec3(0.5F, wrong, 0.5F)), "material 1 with a tint out of range");
    EXPECT_EQ(found_in_phong(&Phong::diffuse, vec3(0.5F, 0.5F, wrong)),
              "material 1 with a diffuse reflectance out of range");
  }
  for (const float wrong : {-1e30F, 0.99F, INFINITY, NAN})
    EXPECT_EQ(found_in_phong(&Phong::shininess, wrong), "material 1 with a shininess out of range");
  for (const float wrong : {-1.0F, 0.0F, INFINITY, NAN})
    EXPECT_EQ(found(&Material::ior, wrong), "material 1 with an index of refraction out of range");
  EXPECT_EQ(found(&Material::mask_bit, 32U), "material 1 with a mask bit out of range");
  EXPECT_EQ(found(&Material::flags, 8U), "material 1 with flags out of range");
  for (const float right : {0.0F, 1.0F}) EXPECT_EQ(found_in_phong(&Phong::mirror, right), "");
}

TEST(SceneCheck, FindsLightsOutOfRange) {
  const auto found = [](const SceneLight& light) {
    return found_after([&](Scene& s) { s.lights[0] = light; });
  };
  EXPECT_EQ(found({LIGHT_POINT, glm::dvec3(0.0), vec3(0.0F)}), "");
  EXPECT_NE(found({LIGHT_KIND_LAST + 1, glm::dvec3(1.0), vec3(1.0F)}), "");
  EXPECT_NE(found({LIGHT_DIRECTIONAL, glm::dvec3(0.0), vec3(1.0F)}), "");
  EXPECT_NE(found({LIGHT_POINT, glm::dvec3(NAN), vec3(1.0F)}), "");
  for (const float wrong : {-1.0F, INFINITY, NAN})
    EXPECT_EQ(found({LIGHT_POINT, glm::dvec3(1.0), vec3(1.0F, wrong, 1.0F)}),
              "light 0 with a power out of range");
  for (const double wrong : {-1.0, 1e31, double(INFINITY), double(NAN)})
    EXPECT_EQ(found({LIGHT_POINT, glm::dvec3(1.0), vec3(1.0F), wrong}), "light 0 with a size out of range");
  EXPECT_NE(found({LIGHT_DIRECTIONAL, glm::dvec3(1.0), vec3(1.0F), 1.6}), "");
  EXPECT_EQ(found({LIGHT_DIRECTIONAL, glm::dvec3(1.0), vec3(1.0F), 1.5}), "");
  const auto rectangle = [&](const glm::dvec3& u, const glm::dvec3& v) {
    return found({LIGHT_RECTANGLE, glm::dvec3(0.0), vec3(1.0F), 0.0, u, v});
  };
  const glm::dvec3 u(3.0, 4.0, 0.0), v(-4.0, 3.0, 0.0);
  EXPECT_EQ(rectangle(u, v), "");
  for (const glm::dvec3& wrong : {glm::dvec3(0.0), u, glm::dvec3(NAN), glm::dvec3(INFINITY, 0.0, 0.0)})
    EXPECT_EQ(rectangle(u, wrong), "light 0 with edges out of range");
}

}  // namespace
}  // namespace splatray
