#include <cmath>
#include <cstring>

#include "app/library/api/guard.h"
#include "app/library/api/scene_impl.h"
#include "engine/scene/scene_check.h"

namespace splatray::api {
namespace {

splatray::View inner_view(const View& view) {
  constexpr std::uint32_t MOST = 32768;
  if (view.width < 1 || view.width > MOST || view.height < 1 || view.height > MOST)
    refuse("a picture of " + std::to_string(view.width) + " x " + std::to_string(view.height) + " pixels",
           "1 to 32768 each way");
  const Camera& camera = view.camera;
  return {
      {vector(camera.eye), vector(camera.target), vector(camera.up), camera.fov_y_deg, camera.ortho_height},
      view.width,
      view.height};
}

splatray::Settings inner_settings(const Look& look, const Settings& settings) {
  constexpr std::uint32_t MOST_SAMPLES = 65536, MOST_BOUNCES = 64;
  constexpr float BRIGHTEST = 1e30F;
  if (settings.samples < 1 || settings.samples > MOST_SAMPLES)
    refuse(std::to_string(settings.samples) + " samples", "1 to 65536");
  if (settings.max_bounces > MOST_BOUNCES)
    refuse(std::to_string(settings.max_bounces) + " bounces", "at most 64");
  if (!(look.environment_strength >= 0.0F && look.environment_strength <= BRIGHTEST))
    refuse("an environment strength of " + std::to_string(look.environment_strength), "0 to 1e30");
  if (!std::isfinite(look.environment_turn))
    refuse("an environment turn that is not finite", "a number of turns");
  splatray::Settings inner;
  inner.samples = settings.samples;
  inner.seed = settings.seed;
  inner.max_bounces = settings.max_bounces;
  inner.shadows = settings.shadows;
  inner.aov = settings.channels;
  inner.environment_strength = look.environment_strength;
  inner.environment_turn = look.environment_turn;
  return inner;
}

/// The materials and lights of a picture.
struct Shown {
  std::vector<splatray::Material> materials;
  std::vector<SceneLight> lights;
};

std::vector<splatray::Material> inner_materials(const splatray::Scene& scene, const Look& look) {
  if (!look.materials.empty() && look.materials.size() != scene.materials.size())
    refuse(std::to_string(look.materials.size()) + " materials",
           "none or as many as the " + std::to_string(scene.materials.size()) + " objects");
  std::vector<splatray::Material> materials = scene.materials;
  for (std::size_t i = 0; i < look.materials.size(); ++i)
    materials[i] = changed(materials[i], look.materials[i]);
  return materials;
}

Shown choose_shown(const LoadedScene& loaded, const Look& look, const splatray::Camera& camera) {
  Shown shown{inner_materials(loaded.scene, look), {}};
  if (look.lights) {
    for (const Light& light : *look.lights)
      shown.lights.push_back({light.kind == Light::Kind::point ? LIGHT_POINT : LIGHT_DIRECTIONAL,
                              vector(light.position), vector(light.power)});
  } else {
    shown.lights =
        own_lights(loaded.scene, !look.environment.empty() || !loaded.environment_name.empty(), camera);
  }
  for (SceneLight& light : shown.lights)
    if (light.kind == LIGHT_DIRECTIONAL && glm::length(light.position) > 0.0)
      light.position = glm::normalize(light.position);
  splatray::Scene checked;
  checked.materials = shown.materials;
  checked.lights = shown.lights;
  if (const auto defect = find_look_defect(checked)) refuse(defect->found, defect->expected);
  return shown;
}

Image outer_image(const splatray::Image& inner) {
  static_assert(sizeof(vec4) == sizeof(std::array<float, 4>));
  Image image{inner.width, inner.height, {}, {}, {}, {}};
  image.pixels.resize(inner.rgba.size());
  std::memcpy(image.pixels.data(), inner.rgba.data(), inner.rgba.size() * sizeof(vec4));
  for (const AovPixel& pixel : inner.aov) {
    image.depth.push_back(pixel.z);
    image.normal.push_back(array(pixel.normal));
    image.object.push_back(pixel.object == NO_OBJECT ? -1 : static_cast<std::int32_t>(pixel.object));
  }
  return image;
}

}  // namespace

Image render(const Scene& scene, const View& view, const Look& look, const Settings& settings,
             const Progress& progress) {
  return guarded(progress, [&](ProgressRelay& relay) {
    Scene::Impl& impl = SceneAccess::impl(scene);
    const splatray::View inner = inner_view(view);
    const splatray::Settings method = inner_settings(look, settings);
    (void)make_frame_params(impl.loaded.scene, inner, method);  // refuses a camera before a device is opened
    const Shown shown = choose_shown(impl.loaded, look, inner.camera);
    return impl.with_tracer([&](Tracer& tracer) {
      impl.show_environment(look.environment.empty() ? impl.loaded.environment_name : look.environment);
      tracer.set_materials(shown.materials);
      tracer.set_lights(shown.lights);
      return outer_image(tracer.render(inner, method, [&](double share) { return relay("tracing", share); }));
    });
  });
}

}  // namespace splatray::api
