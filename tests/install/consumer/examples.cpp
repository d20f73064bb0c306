/// Examples of the library. This file is the page of the documentation, and the tests compile and run it.
#include "examples.h"

#include <chrono>
#include <cmath>
#include <numbers>

namespace sr = splatray::api;

//! [picture]
/// A picture of a file: any format that splatray reads, seen as a whole in the default light.
sr::Image picture_of_a_file(const std::filesystem::path& file) {
  const sr::Scene scene = sr::open(file);
  return sr::render(scene, {{"resolution", "320x180"}});
}
//! [picture]

//! [arrays]
/// A scene of arrays: a sphere of 20 000 points at the coordinates of a survey. Normals and radii may be left out.
sr::Scene scene_of_arrays() {
  constexpr int COUNT = 20000;
  std::vector<sr::Double3> positions;
  std::vector<sr::Float3> normals, colors;
  for (int i = 0; i < COUNT; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / COUNT, turn = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
    const double x = std::sqrt(1.0 - z * z) * std::cos(turn), y = std::sqrt(1.0 - z * z) * std::sin(turn);
    positions.push_back({500000.0 + x, 4000000.0 + y, 100.0 + z});
    normals.push_back({float(x), float(y), float(z)});
    colors.push_back({0.5F + 0.5F * float(z), 0.4F, 0.3F});
  }
  return sr::make_scene({.positions = positions, .normals = normals, .colors = colors, .name = "sphere"});
}
//! [arrays]

//! [mesh]
/// A floor of two triangles, coloured by an attribute of its vertices, and a ball of points on it: one scene of several objects.
sr::Scene ball_on_a_floor() {
  const std::vector<sr::Double3> corners = {{-3, -3, -1}, {3, -3, -1}, {3, 3, -1}, {-3, 3, -1}};
  const std::vector<std::array<std::uint32_t, 3>> triangles = {{0, 1, 2}, {0, 2, 3}};
  const std::vector<double> distance = {0.0, 6.0, 8.5, 6.0};
  sr::Mesh floor{.vertices = corners, .triangles = triangles, .name = "floor"};
  floor.attributes = {{"distance from the corner", distance}};
  std::vector<sr::Double3> ball;
  for (int i = 0; i < 5000; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / 5000, turn = 2.4 * i, r = std::sqrt(1.0 - z * z);
    ball.push_back({r * std::cos(turn), r * std::sin(turn), z});
  }
  const std::vector<sr::Float3> white(ball.size(), {0.9F, 0.9F, 0.9F});
  const sr::Points points{.positions = ball, .colors = white, .name = "ball", .scanned = false};
  const std::vector<sr::Object> objects = {floor, points};
  return sr::make_scene(objects, {{"mesh-points", 20000}, {"color-by", "distance from the corner"}});
}
//! [mesh]

//! [pose]
/// What a calibrated photograph shows: pose and intrinsics as OpenCV has them, off-centre and with pixels that are not square.
sr::Image as_photographed(const sr::Scene& scene) {
  const std::array<std::array<double, 4>, 4> camera_to_world = {
      {{1, 0, 0, 0.5}, {0, 0, 1, -8}, {0, -1, 0, 0}, {0, 0, 0, 1}}};  // looks along +y, down is -z
  const std::array<sr::Double3, 3> k = {{{200.0, 0, 90.5}, {0, 180.0, 60.25}, {0, 0, 1}}};
  sr::Request request = {{"resolution", "160x120"}, {"samples", 4}};
  return sr::render(scene, request.set_camera(sr::camera_from_pose(camera_to_world, k, 160, 120)));
}
//! [pose]

//! [look]
/// Other light and another material; the scene itself stays as it is.
sr::Image gold_at_night(const sr::Scene& scene) {
  const sr::Double3 high = scene.bounds_high();
  sr::Request request = {{"resolution", "320x180"}, {"samples", 4}, {"environment", "0.02,0.02,0.05"}};
  request.add("light", sr::Value(sr::Double3{high[0], high[1], high[2] + 3.0}).text() + ",60,50,40");
  for (const std::string& object : scene.objects()) request.add_material(object, sr::named_material("gold"));
  request.set_camera(sr::frame(scene, {.azimuth_deg = 30.0, .elevation_deg = 40.0, .fov_y_deg = 35.0}));
  return sr::render(scene, request);
}
//! [look]

//! [turntable]
/// Eight pictures from all sides.
void turntable(const sr::Scene& scene, const std::filesystem::path& folder) {
  sr::Request request = {{"resolution", "96x96"}, {"samples", 1}};
  for (int i = 0; i < 8; ++i) {
    request.set_camera(sr::frame(scene, {.azimuth_deg = 45.0 * i, .aspect = 1.0}));
    sr::render(scene, request).save(folder / ("turn" + std::to_string(i) + ".png"));
  }
}
//! [turntable]

//! [lidar]
/// Ranges of a scanner that turns once at `place`, a ray every degree; infinite where nothing is met.
std::vector<float> simulated_lidar(const sr::Scene& scene, const sr::Double3& place) {
  std::vector<sr::Double3> origins(360, place), directions;
  for (int i = 0; i < 360; ++i) {
    const double turn = i * std::numbers::pi / 180.0;
    directions.push_back({std::cos(turn), std::sin(turn), 0.0});
  }
  const sr::Hits hits = sr::trace(scene, origins, directions);
  return {hits.t.begin(), hits.t.end()};
}
//! [lidar]

//! [depth]
/// Depth, normals and objects for each of many poses.
std::vector<sr::Image> depth_of_poses(const sr::Scene& scene, const std::vector<sr::Camera>& poses) {
  std::vector<sr::Image> images;
  sr::Request request = {{"resolution", "160x120"}, {"samples", 1}, {"aov", "depth,normal,id"}};
  for (const sr::Camera& pose : poses) images.push_back(sr::render(scene, request.set_camera(pose)));
  return images;
}
//! [depth]

//! [cancel]
/// Progress, cancelling and errors: what() is a sentence for people, kind() is for programs.
std::string give_up_after(const sr::Scene& scene, double seconds) {
  const auto start = std::chrono::steady_clock::now();
  const sr::Progress progress = [&](const char* /*stage*/, double /*share*/) {
    return std::chrono::steady_clock::now() - start < std::chrono::duration<double>(seconds);
  };
  try {
    (void)sr::render(scene, {{"resolution", "1280x720"}, {"samples", 65536}}, progress);
    return "done";
  } catch (const sr::Error& error) {
    if (error.kind() != sr::ErrorKind::cancelled) throw;
    return error.what();
  }
}
//! [cancel]
