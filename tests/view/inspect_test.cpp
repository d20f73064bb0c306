#include "app/view/model/inspect.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "app/library/picture/aimed_ray.h"
#include "engine/scene/splat.h"
#include "engine/scene/wide/wide_tree.h"
#include "preprocess/build.h"
#include "tests/view/documents.h"

namespace splatray {
namespace {

/// A plane of 41 x 41 points, a millimetre apart, facing +z, at UTM coordinates.
const glm::dvec3 CENTER(561234.125, 5912345.25, 87.5);
constexpr double SPACING = 1e-3;

Scene plane_scene(Insertion insertion = Insertion::overlap) {
  Input input;
  InputObject& object = input.objects.emplace_back();
  object.name = "plane";
  for (int y = -20; y <= 20; ++y)
    for (int x = -20; x <= 20; ++x) {
      object.points.position.push_back(CENTER + SPACING * glm::dvec3(x, y, 0));
      object.points.normal.emplace_back(0.0F, 0.0F, 1.0F);
    }
  BuildStats stats;
  return build_scene(std::move(input), {.insertion = insertion}, 1, stats);
}

View plane_view() {
  View view;
  view.camera = {CENTER + glm::dvec3(0.0, 0.0, 0.1), CENTER, {0.0, 1.0, 0.0}, 30.0, 0.0};
  view.width = 400;
  view.height = 300;
  return view;
}

/// What a tracer answers when the ray meets this splat's plane.
RayHit hit_of(const RayQuery& query, const uvec4& words) {
  const Splat splat = unpack_splat(words);
  RayHit hit{};
  hit.first = words;
  hit.object = splat.object;
  hit.t = static_cast<float>(glm::dot(splat.normal, splat.center - glm::dvec3(query.origin)) /
                             glm::dot(splat.normal, glm::dvec3(query.dir)));
  return hit;
}

/// The splat nearest to a world point.
std::size_t nearest_splat(const Scene& scene, const glm::dvec3& point) {
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < scene.data_pool.size(); ++i) {
    const double distance = glm::length(scene.root.to_world(unpack_splat(scene.data_pool[i]).center) - point);
    if (distance < least) nearest = i;
    least = std::min(least, distance);
  }
  return nearest;
}

TEST(InspectTest, TheCursorsRayGoesThroughWhatProjectsThere) {
  const Scene scene = plane_scene();
  for (const double ortho_height : {0.0, 0.05}) {
    View view = plane_view();
    view.camera.ortho_height = ortho_height;
    const glm::dvec3 point = CENTER + SPACING * glm::dvec3(7, -4, 0);
    const RayQuery query = cursor_query(scene, view, projected(view.camera, point, {400.0, 300.0}));
    const glm::dvec3 offset = scene.root.to_root(point) - glm::dvec3(query.origin);
    const glm::dvec3 dir(query.dir);
    EXPECT_NEAR(glm::length(dir), 1.0, 1e-6);
    EXPECT_LT(glm::length(glm::cross(offset, dir)) * scene.root.unit_world, 0.01 * SPACING);
    EXPECT_EQ(query.from_object, NO_OBJECT);
  }
}

TEST(InspectTest, FindsEachSplatByItsWords) {
  const Scene scene = plane_scene();
  RayHit hit{};
  for (std::size_t i = 0; i < scene.data_pool.size(); ++i) {
    hit.first = scene.data_pool[i];
    ASSERT_EQ(find_splat(scene, hit.first), i);
  }
  hit.first.w ^= 1U << 16U;  // another radius in the same place
  EXPECT_FALSE(find_splat(scene, hit.first).has_value());
  hit.first = uvec4(0);
  EXPECT_FALSE(find_splat(scene, hit.first).has_value());
  EXPECT_FALSE(find_splat(Scene{}, hit.first).has_value());
}

TEST(InspectTest, DescribesTheSplatInWorldCoordinates) {
  const Scene scene = plane_scene();
  const View view = plane_view();
  const glm::dvec3 point = CENTER + SPACING * glm::dvec3(7, -4, 0);
  const RayQuery query = cursor_query(scene, view, projected(view.camera, point, {400.0, 300.0}));
  const std::size_t splat = nearest_splat(scene, point);
  const auto inspected = inspect(scene, view.camera, query, hit_of(query, scene.data_pool[splat]));
  ASSERT_TRUE(inspected.has_value());
  EXPECT_EQ(inspected->object_name, "plane");
  EXPECT_LT(glm::length(inspected->center_world - point), 1e-6);  // a thousandth of the spacing at 6e6
  EXPECT_LT(glm::length(inspected->hit_world - point), 1e-5);
  EXPECT_LT(glm::length(inspected->normal - glm::dvec3(0.0, 0.0, 1.0)), 1e-4);
  EXPECT_GT(inspected->radius_world, 0.5 * SPACING);
  EXPECT_LT(inspected->radius_world, 3.0 * SPACING);
  EXPECT_NEAR(inspected->distance_world, glm::length(point - view.camera.eye), 1e-5);
}

/// Depth and range of the leaf that has entry `reference` of the reference pool, found by walking the whole tree.
void find_leaf(const Scene& scene, std::uint32_t node, std::uint32_t depth, std::uint32_t reference,
               std::uint32_t& leaf_depth, std::uint32_t& leaf_references) {
  const std::uint32_t word = scene.node_pool[node], address = word & NODE_ADDRESS_MASK;
  if (word >> NODE_TAG_SHIFT == NODE_INNER)
    for (std::uint32_t child = 0; child < 8; ++child)
      find_leaf(scene, address + child, depth + 1, reference, leaf_depth, leaf_references);
  if (word >> NODE_TAG_SHIFT != NODE_FILLED) return;
  if (reference < scene.begin_end[address] || reference >= scene.begin_end[address + 1]) return;
  leaf_depth = depth;
  leaf_references = scene.begin_end[address + 1] - scene.begin_end[address];
}

TEST(InspectTest, FindsTheLeafOfEverySplatsCentre) {
  const Scene scene = plane_scene(Insertion::centre);
  const View view = plane_view();
  const RayQuery query = cursor_query(scene, view, {200.0, 150.0});
  std::uint32_t deepest = 0;
  for (std::uint32_t reference = 0; reference < scene.reference_pool.size(); ++reference) {
    std::uint32_t depth = 0, references = 0;
    find_leaf(scene, 0, 0, reference, depth, references);
    const auto inspected =
        inspect(scene, view.camera, query, hit_of(query, scene.data_pool[scene.reference_pool[reference]]));
    ASSERT_TRUE(inspected.has_value());
    EXPECT_EQ(inspected->leaf_depth, depth);
    EXPECT_EQ(inspected->leaf_references, references);
    deepest = std::max(deepest, depth);
  }
  EXPECT_GT(deepest, 2U);
}

TEST(InspectTest, MissesAreNothing) {
  const Scene scene = plane_scene();
  RayHit hit{};
  hit.object = NO_OBJECT;
  EXPECT_FALSE(inspect(scene, plane_view().camera, RayQuery{}, hit).has_value());
}

}  // namespace
}  // namespace splatray
