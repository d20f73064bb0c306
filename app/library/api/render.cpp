#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "app/library/api/guard.h"
#include "app/library/api/scene_impl.h"
#include "engine/base/memory.h"
#include "engine/gpu/tiles.h"
#include "engine/scene/scene_check.h"
#include "engine/scene/surface.h"

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

/// Whether objects are shown of other materials than their own; one that is hidden, or no longer, is of the same.
bool changes_materials(const splatray::Scene& scene, const Look& look) {
  const auto is_other = [](const splatray::Material& own, Material shown) {
    shown.hidden = (own.flags & MATERIAL_HIDDEN) != 0;
    return shown != described(own);
  };
  return look.materials.size() == scene.materials.size() &&
         !std::equal(scene.materials.begin(), scene.materials.end(), look.materials.begin(),
                     [&](const auto& own, const Material& shown) { return !is_other(own, shown); });
}

/// LOOK_* of a style; automatic as the programs have it.
std::uint32_t inner_look(const LoadedScene& loaded, const Look& look) {
  switch (look.style) {
    case Style::paper:
      return LOOK_PAPER;
    case Style::lit:
      return LOOK_LIT;
    case Style::clay:
      return LOOK_CLAY;
    case Style::ambient:
      return LOOK_AO;
    case Style::scan:
      return LOOK_SCAN;
    case Style::automatic: {
      PictureOptions picture;
      if (look.environment.empty()) picture.look = loaded.picture.look;
      picture.environment = look.environment;
      if (look.lights) {
        picture.lights.emplace();
        picture.look.reset();
      }
      const std::uint32_t chosen = choose_look(loaded.scene, picture);
      return !shows_materials(chosen) && changes_materials(loaded.scene, look) ? LOOK_LIT : chosen;
    }
  }
  refuse("style " + std::to_string(static_cast<int>(look.style)), "one of Style's");
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

/// The scene's materials, surfaces and lights as a picture shows them.
splatray::Scene inner_materials(const splatray::Scene& scene, const Look& look) {
  if (!look.materials.empty() && look.materials.size() != scene.materials.size())
    refuse(std::to_string(look.materials.size()) + " materials",
           "none or as many as the " + std::to_string(scene.materials.size()) + " objects");
  splatray::Scene shown;
  shown.materials = scene.materials;
  shown.surfaces = surfaces_of(scene);
  for (std::size_t i = 0; i < look.materials.size(); ++i) {
    if (look.materials[i] == described(scene.materials[i])) continue;  // what else the file says of it stays
    shown.materials[i] = changed(scene.materials[i], look.materials[i]);
    shown.surfaces[i] = surface_of(shown.materials[i]);
  }
  return shown;
}

SceneLight inner_light(const Light& light) {
  constexpr double LARGEST = 1e30, WHOLE_SKY_DEG = 180.0;
  const bool point = light.kind == Light::Kind::point;
  if (!point && light.kind != Light::Kind::directional)
    refuse("a light of kind " + std::to_string(static_cast<int>(light.kind)), "directional or point");
  if (!(light.size >= 0.0 && light.size <= (point ? LARGEST : WHOLE_SKY_DEG)))
    refuse("a light of size " + std::to_string(light.size),
           "0 or more, of directional ones at most 180 degrees");
  SceneLight inner{point ? LIGHT_POINT : LIGHT_DIRECTIONAL, vector(light.position), vector(light.power)};
  inner.size = point ? light.size : light.size * std::numbers::pi / 360.0;
  if (!point && glm::length(inner.position) > 0.0) inner.position = glm::normalize(inner.position);
  return inner;
}

splatray::Scene choose_shown(const LoadedScene& loaded, const Look& look, std::uint32_t inner_look,
                             const splatray::Camera& camera) {
  splatray::Scene shown = inner_materials(loaded.scene, look);
  if (look.lights) {
    for (const Light& light : *look.lights) shown.lights.push_back(inner_light(light));
  } else {
    const bool environment_named = !look.environment.empty() || !loaded.environment_name.empty();
    shown.lights = own_lights(loaded.scene, environment_named, inner_look, camera);
  }
  if (const auto defect = find_look_defect(shown)) refuse(defect->found, defect->expected);
  return shown;
}

/// Puts a band of a picture in its place.
void keep(const splatray::Image& band, std::uint32_t first_row, Image& image) {
  static_assert(sizeof(vec4) == sizeof(std::array<float, 4>));
  const std::size_t first = std::size_t{first_row} * image.width;
  std::memcpy(image.pixels.data() + first, band.rgba.data(), band.rgba.size() * sizeof(vec4));
  for (std::size_t i = 0; i < band.aov.size(); ++i) {
    const AovPixel& pixel = band.aov[i];
    image.depth[first + i] = pixel.z;
    image.normal[first + i] = array(pixel.normal);
    image.object[first + i] = pixel.object == NO_OBJECT ? -1 : static_cast<std::int32_t>(pixel.object);
  }
}

/// An image with room for all pixels. Throws splatray::Error (out_of_memory) where there is not the memory.
Image empty_image(const splatray::View& view, bool channels) {
  const std::size_t pixels = std::size_t{view.width} * view.height;
  constexpr std::size_t PIXEL_BYTES = sizeof(vec4),
                        CHANNEL_BYTES = sizeof(float) + sizeof(Float3) + sizeof(std::int32_t);
  require_memory(
      pixels * (PIXEL_BYTES + (channels ? CHANNEL_BYTES : 0)),
      "a picture of " + std::to_string(view.width) + "x" + std::to_string(view.height) + " pixels");
  Image image{view.width, view.height, {}, {}, {}, {}};
  image.pixels.resize(pixels);
  if (!channels) return image;
  image.depth.resize(pixels);
  image.normal.resize(pixels);
  image.object.resize(pixels);
  return image;
}

/// Renders in bands, so that no pixel is in memory twice.
Image render_bands(Tracer& tracer, splatray::View view, const splatray::Settings& settings,
                   ProgressRelay& relay) {
  constexpr std::uint32_t BAND_PIXELS = 1U << 24U;
  const std::uint32_t rows = cut_into_tiles(view.width, view.height, BAND_PIXELS).front().height;
  Image image = empty_image(view, settings.aov);
  for (std::uint32_t row = 0; row < view.height; row += rows) {
    view.window = {0, row, view.width, std::min(rows, view.height - row)};
    const auto tell = [&](double share) {
      return relay("tracing", (row + share * view.window.height) / view.height);
    };
    keep(tracer.render(view, settings, tell), row, image);
  }
  return image;
}

}  // namespace

Image render(const Scene& scene, const View& view, const Look& look, const Settings& settings,
             const Progress& progress) {
  return guarded(progress, [&](ProgressRelay& relay) {
    const std::shared_ptr<Scene::Impl> impl = SceneAccess::impl(scene);
    const splatray::View inner = inner_view(view);
    splatray::Settings method = inner_settings(look, settings);
    method.look = inner_look(impl->loaded, look);
    (void)make_frame_params(impl->loaded.scene, inner, method);  // refuses a camera before a device is opened
    const splatray::Scene shown = choose_shown(impl->loaded, look, method.look, inner.camera);
    return impl->on_device(relay, [&](SceneOnDevice& there) {
      there.show_environment(look.environment.empty() ? impl->loaded.environment_name : look.environment);
      there.tracer->set_materials(shown.materials, shown.surfaces);
      there.tracer->set_lights(shown.lights);
      return render_bands(*there.tracer, inner, method, relay);
    });
  });
}

}  // namespace splatray::api
