#include <cmath>
#include <numbers>

#include "app/library/api/guard.h"
#include "app/library/api/scene_impl.h"

namespace splatray::api {
namespace {

void check(const Framing& framing) {
  constexpr double LEAST = 1e-4, MOST = 1e4, STRAIGHT_UP = 90.0;
  if (!(framing.aspect >= LEAST && framing.aspect <= MOST))
    refuse("an aspect ratio of " + std::to_string(framing.aspect), "1e-4 to 1e4");
  if (framing.fov_y_deg && !(*framing.fov_y_deg > 0.0 && *framing.fov_y_deg < 180.0))
    refuse("a field of view of " + std::to_string(*framing.fov_y_deg) + " degrees", "between 0 and 180");
  if (framing.azimuth_deg && !std::isfinite(*framing.azimuth_deg))
    refuse("an azimuth that is not finite", "degrees");
  if (framing.elevation_deg && !(std::abs(*framing.elevation_deg) <= STRAIGHT_UP))
    refuse("an elevation of " + std::to_string(*framing.elevation_deg) + " degrees", "-90 to 90");
}

splatray::Camera framed(const LoadedScene& loaded, const Framing& framing) {
  const splatray::Scene& scene = loaded.scene;
  if (framing.azimuth_deg || framing.elevation_deg)
    return angled_camera(scene, framing.aspect, framing.fov_y_deg.value_or(DEFAULT_FOV_Y_DEG),
                         framing.azimuth_deg.value_or(DEFAULT_AZIMUTH_DEG),
                         framing.elevation_deg.value_or(DEFAULT_ELEVATION_DEG));
  if (!scene.camera || !scene.stations.empty()) {
    // Pictures of the library leave nothing out, so that a doll's house would be a closed box.
    const Viewpoint chosen = loaded.facts.viewpoint;
    return viewpoint_camera(scene, chosen == Viewpoint::dollhouse ? Viewpoint::front : chosen, framing.aspect,
                            framing.fov_y_deg);
  }
  splatray::Camera camera = *scene.camera;
  camera.fov_y_deg = framing.fov_y_deg.value_or(camera.fov_y_deg);
  return camera;
}

/// Throws Error (usage) unless the columns of the pose's rotation are the axes of a right-handed frame.
void check_pose(const std::array<std::array<double, 4>, 4>& pose) {
  constexpr double MOST_OFF = 1e-4;  // float32 keeps rotations to 1e-6
  const auto column = [&pose](std::size_t i) { return glm::dvec3(pose[0][i], pose[1][i], pose[2][i]); };
  const glm::dmat3 axes(column(0), column(1), column(2));
  const glm::dmat3 product = glm::transpose(axes) * axes;
  double off = std::abs(glm::determinant(axes) - 1.0);
  for (glm::length_t i = 0; i < 3; ++i)
    for (glm::length_t j = 0; j < 3; ++j) off = std::max(off, std::abs(product[i][j] - (i == j ? 1.0 : 0.0)));
  if (!(off <= MOST_OFF))
    refuse("a pose whose upper left 3 x 3 is no rotation, by " + std::to_string(off),
           "columns of length 1, perpendicular, right-handed");
  if (pose[3] != std::array<double, 4>{0.0, 0.0, 0.0, 1.0})
    refuse("a pose whose last row is another", "0 0 0 1: rows of a camera-to-world matrix");
  const glm::dvec3 eye = column(3);
  if (!std::isfinite(eye.x + eye.y + eye.z)) refuse("a pose that is not finite", "numbers");
}

void check_intrinsics(const std::array<Double3, 3>& k) {
  if (k[0][1] != 0.0 || k[1][0] != 0.0 || k[2] != Double3{0.0, 0.0, 1.0})
    refuse("a K that has skew or another last row", "rows fx 0 cx, 0 fy cy, 0 0 1");
  if (!(k[0][0] > 0.0 && k[1][1] > 0.0 && std::isfinite(k[0][0] + k[1][1] + k[0][2] + k[1][2])))
    refuse("focal lengths " + std::to_string(k[0][0]) + " and " + std::to_string(k[1][1]) +
               " and the centre " + std::to_string(k[0][2]) + ", " + std::to_string(k[1][2]) + " in K",
           "finite pixels, focal lengths above 0");
}

}  // namespace

Camera camera_from_pose(const std::array<std::array<double, 4>, 4>& pose, const std::array<Double3, 3>& k,
                        std::uint32_t width, std::uint32_t height) {
  return guarded([&] {
    check_pose(pose);
    check_intrinsics(k);
    if (width == 0 || height == 0) refuse("a picture without pixels", "a width and height of at least 1");
    Camera camera;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      camera.eye[axis] = pose[axis][3];
      camera.target[axis] = pose[axis][3] + pose[axis][2];
      camera.up[axis] = -pose[axis][1];
    }
    // Pixel (0, 0) has its centre half a pixel from the picture's corner.
    camera.fov_y_deg = 2.0 * std::atan(0.5 * height / k[1][1]) * 180.0 / std::numbers::pi;
    camera.lens_shift = {(k[0][2] + 0.5) / width - 0.5, (k[1][2] + 0.5) / height - 0.5};
    camera.pixel_aspect = k[1][1] / k[0][0];
    return camera;
  });
}

Camera frame(const Scene& scene, const Framing& framing) {
  return guarded([&] {
    check(framing);
    const splatray::Camera camera = framed(SceneAccess::impl(scene)->loaded, framing);
    return Camera{array(camera.eye),   array(camera.target), array(camera.up),
                  camera.fov_y_deg,    camera.ortho_height,  {camera.lens_shift.x, camera.lens_shift.y},
                  camera.pixel_aspect, camera.panorama};
  });
}

}  // namespace splatray::api
