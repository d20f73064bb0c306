#include <gtest/gtest.h>

#include <cmath>

#include "engine/image/view.h"
#include "tests/host/scenes.h"

namespace splatray {
namespace {

constexpr double DEG = 3.14159265358979323846 / 180.0;

/// Largest |x| and |y| of the bounding box's corners in the picture, 1 = its border.
glm::dvec2 reach(const Scene& scene, const Camera& camera, double aspect) {
  const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up));
  const glm::dvec3 top = glm::cross(right, forward);
  const double slope = std::tan(0.5 * camera.fov_y_deg * DEG);
  glm::dvec2 most(0.0);
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 corner = glm::mix(scene.bounds_min_world, scene.bounds_max_world,
                                       glm::bvec3((i & 1) != 0, (i & 2) != 0, (i & 4) != 0));
    const glm::dvec3 q = corner - camera.eye;
    const double depth = glm::dot(q, forward);
    EXPECT_GT(depth, 0.0);
    most =
        glm::max(most, glm::abs(glm::dvec2(glm::dot(q, right) / aspect, glm::dot(q, top)) / (depth * slope)));
  }
  return most;
}

TEST(FramingCamera, FillsThePictureUpToTheMargin) {
  Scene scene = box_scene({5.0, -3.0, 2.0});
  scene.bounds_max_world.x += 3.0;
  for (const double aspect : {0.3, 1.0, 1.78, 4.0})
    for (const double fov : {10.0, 40.0, 100.0}) {
      const glm::dvec2 most = reach(scene, framing_camera(scene, aspect, fov), aspect);
      EXPECT_NEAR(std::max(most.x, most.y), 1.0 / 1.06, 1e-9) << aspect << " " << fov;
    }
}

TEST(FramingCamera, LooksFromTheFrontRightAndAbove) {
  Scene scene = box_scene();
  for (const glm::dvec3 up :
       {glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0)}) {
    scene.up = up;
    const Camera camera = framing_camera(scene, 1.5);
    const glm::dvec3 from = glm::transpose(upright_axes(up)) * glm::normalize(camera.eye - camera.target);
    EXPECT_NEAR(std::asin(from.y) / DEG, 17.0, 1e-6);
    EXPECT_NEAR(std::atan2(from.x, from.z) / DEG, 27.0, 1e-6);
  }
}

TEST(FramingCamera, ShowsASinglePoint) {
  Scene scene = box_scene();
  scene.bounds_min_world = scene.bounds_max_world = glm::dvec3(0.1);
  const Camera camera = framing_camera(scene, 1.0);
  EXPECT_GT(glm::length(camera.eye - camera.target), 0.0);
}

TEST(DefaultCamera, IsTheScenesOwn) {
  Scene scene = box_scene();
  scene.camera = Camera{};
  scene.camera->fov_y_deg = 12.5;
  EXPECT_EQ(default_camera(scene, 1.0).fov_y_deg, 12.5);
  EXPECT_EQ(framing_camera(scene, 1.0).fov_y_deg, DEFAULT_FOV_Y_DEG);
}

TEST(UprightAxes, FrontIsPlusZOrMinusY) {
  EXPECT_EQ(upright_axes({0, 2, 0})[2], glm::dvec3(0, 0, 1));
  EXPECT_EQ(upright_axes({0, 0, 3})[2], glm::dvec3(0, -1, 0));
}

}  // namespace
}  // namespace splatray
