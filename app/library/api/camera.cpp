#include <cmath>

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

splatray::Camera framed(const splatray::Scene& scene, const Framing& framing) {
  if (framing.azimuth_deg || framing.elevation_deg)
    return angled_camera(scene, framing.aspect, framing.fov_y_deg.value_or(DEFAULT_FOV_Y_DEG),
                         framing.azimuth_deg.value_or(DEFAULT_AZIMUTH_DEG),
                         framing.elevation_deg.value_or(DEFAULT_ELEVATION_DEG));
  if (!scene.camera || !scene.stations.empty()) {
    // Pictures of the library leave nothing out, so that a doll's house would be a closed box.
    const Viewpoint chosen = choose_viewpoint(scene);
    return viewpoint_camera(scene, chosen == Viewpoint::dollhouse ? Viewpoint::front : chosen, framing.aspect,
                            framing.fov_y_deg);
  }
  splatray::Camera camera = *scene.camera;
  camera.fov_y_deg = framing.fov_y_deg.value_or(camera.fov_y_deg);
  return camera;
}

}  // namespace

Camera frame(const Scene& scene, const Framing& framing) {
  return guarded([&] {
    check(framing);
    const splatray::Camera camera = framed(SceneAccess::impl(scene)->loaded.scene, framing);
    return Camera{array(camera.eye), array(camera.target), array(camera.up), camera.fov_y_deg,
                  camera.ortho_height};
  });
}

}  // namespace splatray::api
