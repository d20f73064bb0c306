#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/image/view.h"
#include "engine/scene/splat.h"
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

/// A scan of points on the six sides of a box, z up, its scanner in the middle where `sensor` says so.
Scene scanned_box(const glm::dvec3& size, bool roof, bool sensor) {
  Scene scene = scan_scene(box_points(size, roof));
  if (sensor) scene.stations[0].sensor_world = glm::dvec3(0.0);
  return scene;
}

TEST(Viewpoint, FollowsTheShapeOfAScan) {
  EXPECT_EQ(choose_viewpoint(box_scene()), Viewpoint::front) << "no scan";
  EXPECT_EQ(choose_viewpoint(scanned_box({4.0, 5.0, 3.0}, true, true)), Viewpoint::inside);
  EXPECT_EQ(choose_viewpoint(scanned_box({4.0, 5.0, 3.0}, false, true)), Viewpoint::front) << "a yard";
  EXPECT_EQ(choose_viewpoint(scanned_box({4.0, 5.0, 3.0}, true, false)), Viewpoint::dollhouse)
      << "no scanner was inside";
  EXPECT_EQ(choose_viewpoint(scanned_box({400.0, 500.0, 30.0}, false, false)), Viewpoint::oblique);
}

/// A model of these points: no scan.
Scene model(const OrientedPoints& points) {
  Scene scene = scan_scene(points);
  scene.stations.clear();
  return scene;
}

OrientedPoints turned_round(OrientedPoints points) {
  for (auto& [position, normal] : points) normal = -normal;
  return points;
}

TEST(Viewpoint, ModelsOfRoomsAreSeenFromInside) {
  const OrientedPoints room = box_points({4.0, 5.0, 3.0}, true);
  EXPECT_EQ(choose_viewpoint(model(room)), Viewpoint::inside);
  EXPECT_EQ(choose_viewpoint(model(turned_round(room))), Viewpoint::front) << "a box";
  EXPECT_EQ(choose_viewpoint(model(box_points({4.0, 5.0, 3.0}, false))), Viewpoint::front) << "an open box";
  Scene with_camera = model(room);
  with_camera.camera = Camera{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 45.0};
  EXPECT_EQ(choose_viewpoint(with_camera), Viewpoint::front) << "its own camera shows it";
  OrientedPoints house = room;  // walls of 0.2 from outside, too
  for (const auto& point : turned_round(box_points({4.4, 5.4, 3.4}, true))) house.push_back(point);
  EXPECT_EQ(choose_viewpoint(model(house)), Viewpoint::front) << "as much outside as inside";
  OrientedPoints ball;
  for (const auto& [position, normal] : room)
    ball.emplace_back(glm::normalize(position), -glm::normalize(position));
  EXPECT_EQ(choose_viewpoint(model(ball)), Viewpoint::front) << "inside out";
}

TEST(Viewpoint, CamerasStandWhereTheySay) {
  const Scene room = scanned_box({4.0, 6.0, 3.0}, true, true);
  const Camera inside = viewpoint_camera(room, Viewpoint::inside, 1.5, {});
  EXPECT_EQ(inside.eye, glm::dvec3(0.0)) << "at the scanner";
  EXPECT_NEAR(std::abs(glm::normalize(inside.target - inside.eye).y), 1.0, 1e-9) << "along the longer side";
  EXPECT_EQ(inside.fov_y_deg, INSIDE_FOV_Y_DEG);
  const Camera top = viewpoint_camera(room, Viewpoint::top, 1.5, {});
  EXPECT_NEAR(glm::normalize(top.eye - top.target).z, 1.0, 1e-9);
  const Camera oblique = viewpoint_camera(room, Viewpoint::oblique, 1.5, 20.0);
  EXPECT_NEAR(std::asin(glm::normalize(oblique.eye - oblique.target).z) / DEG, 35.0, 1e-6);
  EXPECT_EQ(oblique.fov_y_deg, 20.0);
  const Camera middle =
      viewpoint_camera(scanned_box({4.0, 6.0, 3.0}, true, false), Viewpoint::inside, 1.5, {});
  EXPECT_NEAR(middle.eye.z, -0.15, 0.02) << "at eye height";
}

TEST(Viewpoint, InsideWithoutAStationIsWhereThereIsRoom) {
  OrientedPoints points = box_points({6.0, 6.0, 3.0}, true);
  for (const auto& [position, normal] :
       turned_round(box_points({2.0, 4.0, 2.6}, true)))  // a cupboard in the middle
    points.emplace_back(position - glm::dvec3(0.4, 0.0, 0.2), normal);
  const Camera camera = viewpoint_camera(model(points), Viewpoint::inside, 1.5, {});
  double nearest = 10.0;
  for (const auto& [position, normal] : points)
    nearest = std::min(nearest, glm::distance(position, camera.eye));
  EXPECT_GT(nearest, 1.0) << camera.eye.x << " " << camera.eye.y;
  EXPECT_GT(camera.eye.x, 0.6) << "on the wider side of it";
}

/// The largest |x| and |y| in the picture of points that face the eye, 1 = its border.
double facing_reach(const Scene& scene, const Camera& camera, double aspect) {
  const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up)), top = glm::cross(right, forward);
  const double slope = std::tan(0.5 * camera.fov_y_deg * DEG);
  double most = 0.0;
  for (const uvec4& words : scene.data_pool) {
    const Splat splat = unpack_splat(words);
    const glm::dvec3 q = scene.root.to_world(splat.center) - camera.eye;
    if (glm::dot(splat.normal, q) >= 0.0) continue;
    const double depth = glm::dot(q, forward) * slope;
    most =
        std::max({most, std::abs(glm::dot(q, right)) / (aspect * depth), std::abs(glm::dot(q, top)) / depth});
  }
  return most;
}

TEST(Viewpoint, TheDollhouseIsSeenFromAboveItsFrontAndFillsThePicture) {
  const Scene room = scanned_box({4.0, 5.0, 3.0}, true, false);
  const Camera camera = viewpoint_camera(room, Viewpoint::dollhouse, 1.5, {});
  const glm::dvec3 from = glm::normalize(camera.eye - camera.target);
  EXPECT_LT(from.x, -0.3);
  EXPECT_LT(from.y, -0.5);
  EXPECT_GT(from.z, 0.6);
  EXPECT_NEAR(facing_reach(room, camera, 1.5), 1.0 / 1.06, 0.03) << "walls that are left out need no room";
}

TEST(Viewpoint, OfADepthCameraIsItsOwnCroppedToThePicture) {
  Scene scene = scanned_box({4.0, 5.0, 3.0}, true, true);
  scene.camera = Camera{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 45.0};
  scene.stations[0].rows = 480;
  scene.stations[0].columns = 640;
  EXPECT_EQ(choose_viewpoint(scene), Viewpoint::sensor);
  EXPECT_NEAR(viewpoint_camera(scene, Viewpoint::sensor, 4.0 / 3.0, {}).fov_y_deg, 45.0, 1e-9);
  const Camera wide = viewpoint_camera(scene, Viewpoint::sensor, 16.0 / 9.0, {});
  EXPECT_NEAR(std::tan(0.5 * wide.fov_y_deg * DEG) * 16.0 / 9.0, std::tan(22.5 * DEG) * 4.0 / 3.0, 1e-9)
      << "as wide as the grid";
  EXPECT_EQ(wide.eye, scene.camera->eye);
  EXPECT_NEAR(viewpoint_camera(scene, Viewpoint::sensor, 0.75, {}).fov_y_deg, 45.0, 1e-9) << "no less high";
}

/// A wall across z, as a depth camera at the origin saw it in its frame, y down: 0.8 by 0.6 of the distance, twice as many points to
/// the right; or what a disc holds of it.
Scene seen_wall(bool disc) {
  OrientedPoints points;
  for (int y = 0; y < 90; ++y)
    for (int x = 0; x < 120; ++x) {
      const double right = (x + 0.5) / 120.0, down = (y + 0.5) / 90.0;
      if (disc && std::hypot(right - 0.5, down - 0.5) > 0.5) continue;
      const glm::dvec3 place(2.0 * (0.8 * right - 0.4), 2.0 * (0.6 * down - 0.3), 2.0);
      points.emplace_back(place, glm::dvec3(0, 0, -1));
      if (right > 0.5) points.emplace_back(place, glm::dvec3(0, 0, -1));
    }
  Scene scene = scan_scene(points);
  scene.up = {0.0, -1.0, 0.0};
  return scene;
}

TEST(Viewpoint, OfASensorIsFilledWithWhatFillsItsFrame) {
  const Camera even = viewpoint_camera(seen_wall(false), Viewpoint::sensor, 4.0 / 3.0, {});
  const glm::dvec3 ahead = glm::normalize(even.target - even.eye);
  EXPECT_NEAR(ahead.x, 0.0, 0.015) << "not to where more points are";
  EXPECT_NEAR(std::tan(0.5 * even.fov_y_deg * DEG), 0.3, 0.006);
  const Camera wide = viewpoint_camera(seen_wall(false), Viewpoint::sensor, 16.0 / 9.0, {});
  EXPECT_NEAR(std::tan(0.5 * wide.fov_y_deg * DEG) * 16.0 / 9.0, 0.4, 0.006) << "cropped";
  const Camera widest = viewpoint_camera(seen_wall(false), Viewpoint::sensor, 4.0, {});
  EXPECT_NEAR(std::tan(0.5 * widest.fov_y_deg * DEG), 0.3 / 1.4, 0.006) << "by so much at most";
  EXPECT_EQ(viewpoint_camera(seen_wall(false), Viewpoint::sensor, 4.0, 50.0).fov_y_deg, 50.0);
  const Camera whole = viewpoint_camera(seen_wall(true), Viewpoint::sensor, 16.0 / 9.0, {});
  EXPECT_GE(std::tan(0.5 * whole.fov_y_deg * DEG), 0.28) << "a thing is seen whole";
}

/// A street before a car, as its scanner's rings have it: a band four times as wide as high, full from end to end.
TEST(Viewpoint, OfABandIsCroppedAtItsEnds) {
  OrientedPoints street, thing;
  for (int row = 0; row < 40; ++row)
    for (int column = 0; column < 160; ++column) {
      const double across = (column - 79.5) / 80.0, up = (row - 29.5) / 80.0;
      const glm::dvec3 place = 5.0 * glm::dvec3(across, up, 1.0);
      if (row < 26 || column % 40 < 20) street.emplace_back(place, glm::dvec3(0, 0, -1));
      if (std::abs(up + 0.125) < 0.25 * (1.0 - std::abs(across)))
        thing.emplace_back(place, glm::dvec3(0, 0, -1));
    }
  const auto slope = [](const OrientedPoints& seen, double aspect) {
    Scene scene = scan_scene(seen);
    scene.up = {0.0, 1.0, 0.0};
    scene.stations[0].sensor_world = glm::dvec3(0.0);
    return std::tan(0.5 * viewpoint_camera(scene, Viewpoint::sensor, aspect, {}).fov_y_deg * DEG);
  };
  EXPECT_NEAR(slope(street, 16.0 / 9.0), 1.0 / 2.0 / (16.0 / 9.0), 0.01) << "half of its width";
  EXPECT_NEAR(slope(street, 3.0), 0.25, 0.01) << "filled";
  OrientedPoints posts;
  for (int i = 0; i < 8000; ++i) {
    const double up = std::fmod(i * 0.618034, 1.0) - 0.5,
                 across = (i % 2 == 0 ? -0.5 : 0.4) + 0.1 * (i / 8000.0);
    posts.emplace_back(5.0 * glm::dvec3(across, up, 1.0), glm::dvec3(0, 0, -1));
  }
  EXPECT_GT(slope(posts, 0.25), 1.1) << "as high as wide: not cropped";
  EXPECT_GT(slope(thing, 16.0 / 9.0), 0.85 / (16.0 / 9.0)) << "a thing is seen whole";
}

/// Degrees from the front to the right from where points are seen.
double azimuth_of_view(const OrientedPoints& points) {
  const Scene scene = scan_scene(points);
  const Camera camera = viewpoint_camera(scene, Viewpoint::front, 1.5, {});
  const glm::dvec3 from = glm::transpose(upright_axes(scene.up)) * (camera.eye - camera.target);
  return std::atan2(from.x, from.z) / DEG;
}

TEST(Viewpoint, FlatThingsShowTheirBroadSide) {
  const auto block = [](const glm::dvec3& size) { return turned_round(box_points(size, true)); };
  EXPECT_NEAR(azimuth_of_view(block({2.0, 2.0, 3.0})), DEFAULT_AZIMUTH_DEG, 1e-6);
  EXPECT_NEAR(azimuth_of_view(block({3.0, 2.0, 3.0})), DEFAULT_AZIMUTH_DEG, 1e-6);
  EXPECT_NEAR(azimuth_of_view(block({2.0, 0.2, 3.0})), DEFAULT_AZIMUTH_DEG, 1e-6) << "a plate across";
  EXPECT_NEAR(azimuth_of_view(block({0.2, 2.0, 3.0})), DEFAULT_AZIMUTH_DEG + 30.0, 1e-6) << "from its edge";
  OrientedPoints facade;
  for (const auto& point : block({0.2, 2.0, 3.0}))
    if (point.second.x < 0.0) facade.push_back(point);
  EXPECT_LT(azimuth_of_view(facade), -50.0) << "not from behind";
}

/// A grid of 640 x 480 whose first columns saw nothing, as those of a stereo camera.
TEST(Viewpoint, OfADepthCameraIsFilledWithWhatItSaw) {
  OrientedPoints seen;
  for (int row = 0; row < 96; ++row)
    for (int column = 32; column < 128; ++column)
      seen.emplace_back(2.0 * glm::dvec3((column - 63.5) / 120.0, (row - 47.5) / 120.0, 1.0),
                        glm::dvec3(0, 0, -1));
  Scene scene = scan_scene(seen);
  scene.up = {0.0, -1.0, 0.0};
  scene.stations[0].rows = 96;
  scene.stations[0].columns = 128;
  scene.camera = Camera{.eye = {0, 0, 0}, .target = {0, 0, 1}, .up = {0, -1, 0}};
  scene.camera->fov_y_deg = 2.0 * std::atan(48.0 / 120.0) / DEG;
  const Camera camera = viewpoint_camera(scene, Viewpoint::sensor, 4.0 / 3.0, {});
  EXPECT_EQ(camera.eye, glm::dvec3(0.0));
  EXPECT_NEAR(glm::normalize(camera.target).x, 16.0 / 120.0, 0.01) << "to the middle of what it saw";
  EXPECT_NEAR(std::tan(0.5 * camera.fov_y_deg * DEG), 0.75 * 48.0 / 120.0, 0.01) << "and as wide as that";
}

TEST(FramingCamera, OfAScanIgnoresStrays) {
  OrientedPoints points = box_points({4.0, 5.0, 3.0}, true);
  const Camera clean = framing_camera(scan_scene(points), 1.5);
  for (int i = 0; i < 20; ++i)
    points.emplace_back(glm::dvec3(40.0 + 0.01 * i, 3.0, 9.0), glm::dvec3(0, 0, 1));
  const Camera strayed = framing_camera(scan_scene(points), 1.5);
  EXPECT_LT(glm::distance(clean.eye, strayed.eye), 0.02 * glm::length(clean.eye));
  Scene model = scan_scene(points);
  model.stations.clear();
  EXPECT_GT(glm::length(framing_camera(model, 1.5).eye), 2.0 * glm::length(clean.eye))
      << "a model is shown whole";
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
