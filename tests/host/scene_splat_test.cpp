/// A scene's splats as their readers get them.
#include "engine/scene/scene_splat.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace splatray {
namespace {

/// Splats at x = 1000, 2000 and so on, root space, with normals, radii and objects of their own.
Scene row_of(std::size_t count) {
  Scene scene;
  scene.root = {{500000.25, 5000000.5, -12.125}, 0.00123};
  for (std::size_t i = 1; i <= count; ++i) {
    const auto x = static_cast<double>(i);
    scene.data_pool.edit().push_back(pack_splat({{1000.0 * x, 7.0, 2000000.0},
                                                 glm::normalize(glm::dvec3(x, 2.0, -1.0)),
                                                 10.0 * x * x,
                                                 static_cast<std::uint32_t>(i % 3)}));
  }
  return scene;
}

TEST(SceneSplat, HasTheNumbersOfItsWordsInWorldUnits) {
  const Scene scene = row_of(7);
  ASSERT_EQ(splat_count(scene), 7U);
  for (std::size_t i = 0; i < splat_count(scene); ++i) {
    const Splat decoded = unpack_splat(scene.data_pool[i]);
    const SceneSplat splat = splat_at(scene, i);
    EXPECT_EQ(splat.center_world(), scene.root.origin_world + decoded.center * 0.00123);
    EXPECT_EQ(splat.normal(), decoded.normal);
    EXPECT_EQ(splat.radius_world(), std::sqrt(decoded.radius_squared) * 0.00123);
    EXPECT_EQ(splat.object(), decoded.object);
    EXPECT_EQ(splat.in_root().center, decoded.center);
    EXPECT_EQ(splat.words(), scene.data_pool[i]);
  }
}

TEST(SceneSplat, AreVisitedInOrderAndByAStride) {
  const Scene scene = row_of(7);
  for (const auto& [stride, expected] : std::vector<std::pair<std::size_t, std::vector<std::size_t>>>{
           {1, {0, 1, 2, 3, 4, 5, 6}}, {2, {0, 2, 4, 6}}, {3, {0, 3, 6}}, {4, {0, 4}}, {7, {0}}, {9, {0}}}) {
    std::vector<std::size_t> visited;
    const auto visit = [&](std::size_t i, const SceneSplat& splat) {
      visited.push_back(i);
      EXPECT_EQ(splat.words(), scene.data_pool[i]);
    };
    for_each_splat(scene, visit, stride);
    EXPECT_EQ(visited, expected) << stride;
  }
  for_each_splat(Scene{}, [](std::size_t, const SceneSplat&) { ADD_FAILURE(); });
}

}  // namespace
}  // namespace splatray
