#include "preprocess/ground.h"

#include <gtest/gtest.h>

#include "engine/image/view.h"
#include "engine/scene/splat.h"
#include "preprocess/build.h"

namespace splatray {
namespace {

/// A square of discs on its edge, z up.
Scene built(bool ground) {
  InputObject object;
  object.name = "wall";
  object.material = default_material();
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j) {
      object.points.position.emplace_back(0.1 * i, 3.0, 5.0 + 0.1 * j);
      object.points.normal.emplace_back(0.0F, -1.0F, 0.0F);
    }
  Input input;
  input.objects.push_back(std::move(object));
  input.up = glm::dvec3(0.0, 0.0, 1.0);
  BuildParams params;
  params.ground = ground;
  BuildStats stats;
  return build_scene(std::move(input), params, 1, stats, {});
}

TEST(Ground, LiesBelowAllElseAndFacesUp) {
  const Scene scene = built(true);
  ASSERT_EQ(scene.object_names, (std::vector<std::string>{"wall", "ground"}));
  std::size_t count = 0;
  for (const uvec4& words : scene.data_pool) {
    const Splat splat = unpack_splat(words);
    if (splat.object != 1) continue;
    ++count;
    EXPECT_LT(scene.root.to_world(splat.center).z, 5.0);
    EXPECT_GT(scene.root.to_world(splat.center).z, 4.99);
    EXPECT_GT(splat.normal.z, 0.999F);
  }
  EXPECT_EQ(count, 17U * 17U);
}

TEST(Ground, ChangesNeitherBoundsNorCamera) {
  const Scene with = built(true), without = built(false);
  EXPECT_EQ(without.object_names.size(), 1U);
  EXPECT_EQ(with.bounds_min_world, without.bounds_min_world);
  EXPECT_EQ(with.bounds_max_world, without.bounds_max_world);
  const Camera a = default_camera(with, 1.5), b = default_camera(without, 1.5);
  EXPECT_LT(glm::length(a.eye - b.eye), 1e-3 * without.diagonal_world());
  EXPECT_LT(glm::length(a.target - b.target), 1e-3 * without.diagonal_world());
}

}  // namespace
}  // namespace splatray
