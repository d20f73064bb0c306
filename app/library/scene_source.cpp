#include "app/library/scene_source.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "app/library/image_file.h"
#include "app/library/materials.h"
#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "engine/base/number_text.h"
#include "engine/file/scene_file.h"
#include "engine/image/upright.h"
#include "engine/scene/surface.h"
#include "preprocess/base/file_extension.h"

namespace splatray {
namespace {

glm::dvec3 bounds_center(const Scene& scene) {
  return 0.5 * (scene.bounds_min_world + scene.bounds_max_world);
}

void tell(const LoadListener& listener, const char* stage, double share) {
  if (listener.progress && !listener.progress(stage, share))
    throw Error(ExitCode::interrupted, "loading was interrupted");
}

Scene preprocess(const SceneOptions& options, const LoadListener& listener, BuildStats& stats) {
  const Progress progress = watching_memory(listener.progress);
  ReadOptions reading = read_options(options, progress);
  reading.turn_outwards =
      !options.material.empty() && (named_material(options.material).flags & MATERIAL_DIELECTRIC) != 0;
  Input input = read_input(options.inputs, reading);
  const auto tell_notes = [&](const std::vector<std::string>& notes) {
    if (listener.note) std::for_each(notes.begin(), notes.end(), listener.note);
  };
  tell_notes(input.notes);
  Scene scene = build_scene(std::move(input), options.params, options.threads, stats, progress);
  tell_notes(stats.notes);
  return scene;
}

void apply_material(Scene& scene, const std::string& name) {
  if (scene.materials.size() != 1)
    throw Error(ExitCode::usage, "found --material with a scene of " +
                                     std::to_string(scene.materials.size()) +
                                     " objects, expected one object");
  scene.materials[0] = named_material(name);
  scene.surfaces.clear();
}

/// Whether a material is another than readers give to points, whose base colour alone depends on them.
bool is_chosen(const Material& material) {
  const Material plain = default_material();
  return material.specular != plain.specular || material.shininess != plain.shininess ||
         material.mirror != plain.mirror || (material.flags & MATERIAL_DIELECTRIC) != 0;
}

/// Applies --object.
void change_objects(const std::vector<ObjectOptions>& options, Scene& scene) {
  if (options.empty()) return;
  ObjectLooks looks{scene.materials, surfaces_of(scene)};
  apply_object_options(options, scene.object_names, looks);
  scene.materials = std::move(looks.materials);
  scene.surfaces = std::move(looks.surfaces);
}

/// Upwards in a picture, or across that where the camera looks straight up or down.
glm::dvec3 up_across(const glm::dvec3& up, const glm::dvec3& view_dir) {
  const glm::dmat3 axes = upright_axes(up);
  return glm::length(glm::cross(axes[1], view_dir)) > 1e-6 * glm::length(view_dir) ? axes[1] : -axes[2];
}

/// The light, as bright as it asks for or else with irradiance pi at the scene's centre.
SceneLight scene_light(const Scene& scene, const LightOptions& light) {
  const glm::dvec3 to_light = light.position - bounds_center(scene);
  const double squared_distance = light.kind == LIGHT_POINT ? glm::dot(to_light, to_light) : 1.0;
  const glm::vec3 irradiance_pi(static_cast<float>(std::numbers::pi * squared_distance));
  SceneLight made{light.kind, light.position, light.power.value_or(irradiance_pi)};
  made.size = light.kind == LIGHT_DIRECTIONAL ? light.size * std::numbers::pi / 360.0 : light.size;
  return made;
}

/// The key light for LOOK_SCAN, whose sky gives most of the light: softer and weaker.
SceneLight scan_light(SceneLight key) {
  key.size = 0.12;
  key.power *= 0.5F;
  return key;
}

/// A rectangle whose width is level, facing its target.
SceneLight rectangle_light(const glm::dvec3& up, const LightOptions& light) {
  const glm::dvec3 to_target = light.target - light.position;
  const double distance_squared = glm::dot(to_target, to_target);
  const glm::dvec3 normal = to_target / std::sqrt(distance_squared);
  const glm::dvec3 level = glm::normalize(glm::cross(up_across(up, normal), normal));
  const double radiance = std::numbers::pi * distance_squared / (light.edges.x * light.edges.y);
  SceneLight made{LIGHT_RECTANGLE, light.position,
                  light.power.value_or(glm::vec3(static_cast<float>(radiance)))};
  made.edge_u = 0.5 * light.edges.x * level;
  made.edge_v = 0.5 * light.edges.y * glm::cross(normal, level);
  return made;
}

bool is_scene_file(const std::filesystem::path& path) { return lower_extension(path) == ".soct"; }

}  // namespace

void require_scene_alone(const std::vector<std::filesystem::path>& inputs) {
  if (inputs.size() > 1 && std::any_of(inputs.begin(), inputs.end(), is_scene_file))
    throw Error(ExitCode::usage, "found a .soct beside other inputs, expected it alone");
}

LoadedScene load_scene(const SceneOptions& options, const PictureOptions& picture,
                       const LoadListener& listener) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  LoadedScene loaded;
  tell(listener, "reading", 0.0);
  require_scene_alone(options.inputs);
  if (is_scene_file(options.inputs.front())) {
    loaded.scene = read_scene(options.inputs.front(), listener.progress);
  } else {
    loaded.scene = preprocess(options, listener, loaded.build.emplace());
  }
  loaded.load_ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  if (!options.material.empty()) apply_material(loaded.scene, options.material);
  change_objects(picture.objects, loaded.scene);
  loaded.scene.up = picture.up.value_or(upright(loaded.scene));
  SuitedPicture suited = suited_picture(loaded.scene, picture);
  loaded.picture = std::move(suited.picture);
  loaded.told = std::move(suited.told);
  loaded.legend = show_attributes(loaded.scene, loaded.picture.attributes);
  loaded.environment_name = choose_environment_name(loaded.scene, picture);
  return loaded;
}

Camera choose_camera(const Scene& scene, const PictureOptions& picture) {
  const double aspect = static_cast<double>(picture.width) / picture.height;
  if (picture.eye) {
    const glm::dvec3 target = picture.target.value_or(bounds_center(scene));
    const auto up = picture.camera_up ? picture.camera_up : picture.up;
    return {*picture.eye, target, up.value_or(up_across(scene.up, target - *picture.eye)),
            picture.fov_y_deg.value_or(DEFAULT_FOV_Y_DEG), picture.ortho_height};
  }
  // A depth camera's view suits the picture's shape; a model's own camera is its author's.
  if (!scene.camera || !scene.stations.empty() || picture.up || picture.viewpoint != Viewpoint::automatic)
    return viewpoint_camera(scene, picture.viewpoint, aspect, picture.fov_y_deg);
  Camera camera = *scene.camera;
  camera.fov_y_deg = picture.fov_y_deg.value_or(camera.fov_y_deg);
  return camera;
}

glm::dvec3 choose_up(const Scene& scene, const PictureOptions& picture) {
  return picture.up.value_or(scene.up);
}

std::string choose_environment_name(const Scene& scene, const PictureOptions& picture) {
  return picture.environment.empty() ? scene.environment_path : picture.environment;
}

std::vector<SceneLight> choose_lights(const Scene& scene, const PictureOptions& picture,
                                      const Camera& camera) {
  if (picture.lights) {
    if (picture.lights->size() > LIGHTS_MOST)
      throw Error(ExitCode::usage, "found " + std::to_string(picture.lights->size()) +
                                       " lights in --light and --sun, expected at most " +
                                       std::to_string(LIGHTS_MOST));
    std::vector<SceneLight> lights;
    for (const LightOptions& light : *picture.lights)
      lights.push_back(light.kind == LIGHT_RECTANGLE ? rectangle_light(choose_up(scene, picture), light)
                                                     : scene_light(scene, light));
    return lights;
  }
  return own_lights(scene, !choose_environment_name(scene, picture).empty(), choose_look(scene, picture),
                    camera);
}

std::vector<SceneLight> own_lights(const Scene& scene, bool environment_named, std::uint32_t look,
                                   const Camera& camera) {
  if (!scene.lights.empty()) return exposed_lights(scene);
  if (environment_named) return {};
  std::vector<SceneLight> lights = default_lights(scene, camera);
  if (look == LOOK_SCAN) lights.front() = scan_light(lights.front());
  return lights;
}

LightOptions light_options(const SceneLight& light) {
  LightOptions options{light.kind, light.position, light.power};
  options.size = light.kind == LIGHT_DIRECTIONAL ? light.size * 360.0 / std::numbers::pi : light.size;
  if (light.kind != LIGHT_RECTANGLE) return options;
  options.size = 0.0;
  options.target = light.position + glm::normalize(glm::cross(light.edge_u, light.edge_v));
  options.edges = 2.0 * glm::dvec2(glm::length(light.edge_u), glm::length(light.edge_v));
  return options;
}

std::optional<Environment> built_in_environment(const std::string& name) {
  if (name.empty() || name == "studio") return studio_environment();
  if (name == "white") return Environment{0, 0, {}, vec3(1.0F)};
  if (name == "black") return Environment{0, 0, {}, vec3(0.0F)};
  const std::vector<double> numbers = split_numbers(name, ',', 3);
  if (numbers.empty()) return {};
  const vec3 radiance(numbers[0], numbers[1], numbers[2]);
  if (!(glm::all(glm::greaterThanEqual(radiance, vec3(0.0F))) &&
        std::isfinite(radiance.x + radiance.y + radiance.z)))
    throw Error(ExitCode::usage, "--env: found '" + name + "', expected a radiance of finite numbers >= 0");
  return Environment{0, 0, {}, radiance};
}

Environment choose_environment(const std::string& name) {
  auto environment = built_in_environment(name);
  return environment ? *std::move(environment) : read_environment(name);
}

std::uint32_t choose_look(const Scene& scene, const PictureOptions& picture) {
  if (picture.look) return *picture.look;
  const bool plain = scene.lights.empty() && picture.environment.empty() && scene.environment_path.empty() &&
                     !picture.lights;
  const bool materials = std::any_of(scene.materials.begin(), scene.materials.end(), is_chosen) ||
                         std::any_of(picture.objects.begin(), picture.objects.end(), changes_look);
  return !scene.stations.empty() && plain && !materials ? LOOK_SCAN : LOOK_LIT;
}

bool shows_materials(std::uint32_t look) { return look == LOOK_LIT || look == LOOK_PAPER; }

Settings choose_settings(const Scene& scene, const PictureOptions& picture) {
  Settings settings = picture.settings;
  settings.look = choose_look(scene, picture);
  settings.lens_radius_world = 0.5 * picture.aperture_world;
  settings.delta_world = picture.delta_world.value_or(1e-3 * scene.diagonal_world());
  return settings;
}

}  // namespace splatray
