#include "engine/image/view.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/error.h"
#include "tests/host/pixel_ray.h"
#include "tests/host/scenes.h"

namespace splatray {
namespace {

constexpr double EDGE = 1U << LATTICE_BITS;

/// Pixel position of a world point, by the textbook: axes of the camera, then perspective division.
glm::dvec2 project(const View& view, const glm::dvec3& world) {
  const Camera& camera = view.camera;
  const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up));
  const glm::dvec3 q = world - camera.eye;
  const double focal = 0.5 * view.height / std::tan(camera.fov_y_deg * M_PI / 360.0);
  const double scale =
      camera.ortho_height > 0.0 ? view.height / camera.ortho_height : focal / glm::dot(q, forward);
  return {(0.5 + camera.lens_shift.x) * view.width + scale / camera.pixel_aspect * glm::dot(q, right),
          (0.5 + camera.lens_shift.y) * view.height - scale * glm::dot(q, glm::cross(right, forward))};
}

/// Distance of the point from the ray, lattice units; checks the depth along the ray too.
double miss_distance(const Scene& scene, const View& view, const glm::dvec3& world) {
  const FrameParams frame = make_frame_params(scene, view, {});
  const glm::dvec2 pixel = project(view, world);
  const PixelRay ray = pixel_ray(frame, static_cast<float>(pixel.x), static_cast<float>(pixel.y));
  const glm::dvec3 dir = glm::normalize(glm::dvec3(ray.dir));
  const glm::dvec3 q = scene.root.to_root(world) - glm::dvec3(ray.point);
  const double t = glm::dot(q, dir);
  EXPECT_GT(t, frame.t_min);
  double depth = glm::length(world - view.camera.eye);
  if (view.camera.ortho_height > 0.0)
    depth = glm::dot(world - view.camera.eye, glm::normalize(view.camera.target - view.camera.eye));
  EXPECT_NEAR((ray.eye_distance + t) * scene.root.unit_world / depth, 1.0, 1e-5);
  return glm::length(q - t * dir);
}

View view_from(const glm::dvec3& eye, double fov_y_deg) {
  View view;
  view.camera = {eye, {0.1, -0.1, 0.2}, {0.1, 1.0, 0.0}, fov_y_deg, 0.0};
  view.width = 1280;
  view.height = 720;
  return view;
}

const glm::dvec3 POINTS[] = {{0.9, 0.8, 0.7}, {-0.9, 0.3, -0.6}, {0.2, -0.7, 0.95}, {0.0, 0.0, 0.0}};

TEST(FrameParams, TopLeftIsUpAndLeft) {
  View view = view_from({0.0, 0.0, 5.0}, 40.0);
  view.camera.target = glm::dvec3(0.0);
  view.camera.up = {0.0, 1.0, 0.0};
  const FrameParams frame = make_frame_params(box_scene(), view, {});
  const PixelRay corner = pixel_ray(frame, 0.0F, 0.0F);
  EXPECT_LT(corner.dir.x, 0.0F);
  EXPECT_GT(corner.dir.y, 0.0F);
  const PixelRay center = pixel_ray(frame, 640.0F, 360.0F);
  EXPECT_LT(glm::length(glm::normalize(center.dir) - glm::vec3(0.0F, 0.0F, -1.0F)), 1e-6F);
  EXPECT_EQ(frame.t_min, 0.0F);
  EXPECT_EQ(frame.width, 1280U);
  EXPECT_EQ(frame.tile_height, 720U);
}

TEST(FrameParams, NearRaysMeetTheirPoints) {
  for (const glm::dvec3& point : POINTS)
    EXPECT_LT(miss_distance(box_scene(), view_from({2.0, 1.0, 4.0}, 35.0), point), 2.0);
}

TEST(FrameParams, ShiftedLensesAndWidePixelsMeetTheirPoints) {
  for (const double distance : {1.0, 20.0, 1e4})
    for (const double ortho_height : {0.0, 3.0}) {
      View view = view_from(distance * glm::dvec3(2.0, 1.0, 4.0), 35.0 / distance);
      view.camera.ortho_height = ortho_height;
      view.camera.lens_shift = {0.3, -0.2};
      view.camera.pixel_aspect = 1.25;
      const double limit = ortho_height > 0.0 ? 4.0 : 2.0;
      for (const glm::dvec3& point : POINTS)
        EXPECT_LT(miss_distance(box_scene(), view, point), limit) << distance;
    }
}

TEST(FrameParams, RefusesLensesThatAreNone) {
  View view = view_from({2.0, 1.0, 4.0}, 35.0);
  for (const double shift : {101.0, std::nan("")}) {
    view.camera.lens_shift = {shift, 0.0};
    EXPECT_THROW((void)make_frame_params(box_scene(), view, {}), Error) << shift;
  }
  view.camera.lens_shift = {0.0, 0.0};
  for (const double aspect : {0.0, -1.0, 1e3, std::nan("")}) {
    view.camera.pixel_aspect = aspect;
    EXPECT_THROW((void)make_frame_params(box_scene(), view, {}), Error) << aspect;
  }
}

/// The same direction of view across the switch between rays from the eye and rays from a plane.
TEST(FrameParams, NearAndFarAgree) {
  const glm::dvec3 direction = glm::normalize(glm::dvec3(0.3, 0.2, 1.0));
  for (const double edges : {3.9, 4.2}) {
    const View view = view_from(edges * 2.5 * direction, 12.0);
    const FrameParams frame = make_frame_params(box_scene(), view, {});
    EXPECT_EQ(std::isinf(frame.t_min), edges > 4.1);
    EXPECT_EQ(frame.depth_per_dir, edges > 4.1 ? 1.0F : 0.0F);
    for (const glm::dvec3& point : POINTS) EXPECT_LT(miss_distance(box_scene(), view, point), 2.0);
  }
}

TEST(FrameParams, FarEyeKeepsItsPrecision) {
  const double distance = 1e6;
  const View view =
      view_from(glm::normalize(glm::dvec3(1.0, 0.5, 2.0)) * distance, 2.8 / distance * 180.0 / M_PI);
  for (const glm::dvec3& point : POINTS) EXPECT_LT(miss_distance(box_scene(), view, point), 2.0);
}

TEST(FrameParams, FarSceneKeepsItsPrecision) {
  const glm::dvec3 offset(4e6, 5e6, 100.0);
  View view = view_from(glm::dvec3(2.0, 1.0, 4.0) + offset, 35.0);
  view.camera.target += offset;
  for (const glm::dvec3& point : POINTS)
    EXPECT_LT(miss_distance(box_scene(offset), view, point + offset), 2.0);
}

TEST(FrameParams, OrthographicRaysAreParallelAndStartAtTheEyePlane) {
  for (const double distance : {0.2, 5.0, 1e5}) {
    View view = view_from(glm::dvec3(0.0, 0.0, distance), 40.0);
    view.camera.ortho_height = 3.0;
    view.camera.target = glm::dvec3(0.0);
    const Scene scene = box_scene();
    const FrameParams frame = make_frame_params(scene, view, {});
    EXPECT_EQ(frame.dir_dx, glm::vec3(0.0F));
    EXPECT_NEAR(glm::length(frame.dir_00), 1.0F, 1e-6F);
    EXPECT_NEAR(frame.t_min * scene.root.unit_world / distance, -1.0, 1e-6);
    EXPECT_LT(miss_distance(scene, view, {0.4, 0.3, 0.1}), 2.0);
  }
}

TEST(FrameParams, EnvironmentTurnsAboutUp) {
  Scene scene = box_scene();
  Settings settings;
  const View view = view_from({0.0, 0.0, 5.0}, 40.0);
  scene.up = {0.0, 0.0, 2.0};
  FrameParams frame = make_frame_params(scene, view, settings);
  EXPECT_EQ(frame.environment_up, glm::vec3(0.0F, 0.0F, 1.0F));
  EXPECT_EQ(frame.environment_right, glm::vec3(1.0F, 0.0F, 0.0F));
  settings.environment_turn = 0.25F;
  frame = make_frame_params(scene, view, settings);
  EXPECT_LT(glm::length(frame.environment_right - glm::vec3(0.0F, 1.0F, 0.0F)), 1e-6F);
}

TEST(FrameParams, CopiesTheSettings) {
  Settings settings;
  settings.samples = 5;
  settings.seed = 9;
  settings.max_bounces = 3;
  settings.delta_world = 0.5;
  const Scene scene = box_scene();
  const FrameParams frame = make_frame_params(scene, view_from({0.0, 0.0, 5.0}, 40.0), settings);
  EXPECT_EQ(frame.sample_end, 5U);
  EXPECT_EQ(frame.sample_begin, 0U);
  EXPECT_EQ(frame.seed, 9U);
  EXPECT_EQ(frame.max_bounces, 3U);
  EXPECT_NEAR(frame.delta / EDGE, 0.5 / 2.5, 1e-6);
}

TEST(FrameParams, RefusesCamerasThatSeeNothing) {
  const View good = view_from({0.0, 0.0, 5.0}, 40.0);
  const auto refused = [&](auto change) {
    View view = good;
    change(view);
    try {
      (void)make_frame_params(box_scene(), view, {});
    } catch (const Error& error) {
      return error.code() == ExitCode::usage;
    }
    return false;
  };
  EXPECT_FALSE(refused([](View&) {}));
  EXPECT_TRUE(refused([](View& v) { v.camera.target = v.camera.eye; }));
  EXPECT_TRUE(refused([](View& v) { v.camera.up = v.camera.eye - v.camera.target; }));
  EXPECT_TRUE(refused([](View& v) { v.camera.up = glm::dvec3(0.0); }));
  EXPECT_TRUE(refused([](View& v) { v.camera.eye.x = NAN; }));
  EXPECT_TRUE(refused([](View& v) { v.camera.eye.z = 1e300; }));
  EXPECT_TRUE(refused([](View& v) { v.camera.fov_y_deg = 180.0; }));
  EXPECT_TRUE(refused([](View& v) { v.camera.fov_y_deg = 0.0; }));
  EXPECT_TRUE(refused([](View& v) { v.camera.ortho_height = -1.0; }));
  EXPECT_TRUE(refused([](View& v) { v.width = 0; }));
  const auto panorama = [](View& v) {
    v.camera.panorama = true;
    v.width = 2 * v.height;
  };
  EXPECT_FALSE(refused(panorama));
  EXPECT_TRUE(refused([&](View& v) {
    panorama(v);
    v.width += 2;
  }));
  EXPECT_TRUE(refused([&](View& v) {
    panorama(v);
    v.camera.eye = glm::dvec3(1e4);
  }));
}

}  // namespace
}  // namespace splatray
