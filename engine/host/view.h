/// A picture is a value: View (camera, size) + Settings (method) -> Image. Viewer, headless program, tests and benchmarks
/// all use it.
#pragma once
#include <cstdint>

#include "engine/host/scene.h"

namespace splatray {

struct View {
  Camera camera;
  std::uint32_t width = 1920;   ///< pixels, >= 1
  std::uint32_t height = 1080;  ///< pixels, >= 1
};

/// The method of a picture. Enumerators are the BLEND_*, KERNEL_*, SIDE_*, ORDER_* numbers of shaders/layout.h.
struct Settings {
  std::uint32_t samples = 16;      ///< per pixel, >= 1; one sample goes through the pixel's centre
  std::uint32_t seed = 1;
  std::uint32_t max_bounces = 8;   ///< secondary rays in a path, 0..64
  bool shadows = true;
  std::uint32_t blend = BLEND_WINDOW;
  std::uint32_t kernel = KERNEL_RIM;
  float kappa = 1.0F;              ///< window depth / radius of the first splat, > 0
  std::uint32_t side = SIDE_SIDE;
  double delta_world = 0.0;        ///< SIDE_DELTA: minimum distance, world units
  std::uint32_t order = ORDER_Z;
  bool counters = false;           ///< compile the counters in
  bool aov = false;                ///< also trace the centre rays' normal, depth, object
  float environment_strength = 1.0F;
  float environment_turn = 0.0F;   ///< turns about the up axis
};

/// A camera that shows the whole scene from its front, a little from above and to the side, for the given aspect ratio.
/// The scene's own camera when it has one.
[[nodiscard]] Camera default_camera(const Scene& scene, double aspect);
/// As default_camera, but ignores the scene's own camera.
[[nodiscard]] Camera framing_camera(const Scene& scene, double aspect);

/// The light a scene without lights is shown in: a key light over the viewer's left shoulder.
[[nodiscard]] std::vector<SceneLight> default_lights(const Scene& scene, const Camera& camera);

/// Everything a frame needs of View, Settings and Scene, in root space, computed in float64. Tile and sample range cover the
/// whole picture; `environment` and `irradiance` are left zero (the tracer
/// fills them from its Environment). Throws Error (usage) for a camera that sees
/// nothing: eye == target, up parallel to the view, non-finite values, fov outside (0, 180), zero sizes.
[[nodiscard]] FrameParams make_frame_params(const Scene& scene, const View& view, const Settings& settings);

/// Lights in root space, as the engine uploads them.
[[nodiscard]] std::vector<Light> lights_in_root(const Scene& scene, const std::vector<SceneLight>& lights);

}  // namespace splatray
