#include "app/library/picture/scene_source.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "app/library/image_file.h"
#include "app/library/materials.h"
#include "app/library/sheet/sheet.h"
#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "engine/base/number_text.h"
#include "engine/file/scene_file.h"
#include "engine/image/point_sample.h"
#include "engine/image/upright.h"
#include "engine/scene/look_style.h"
#include "engine/scene/sky/daylight.h"
#include "engine/scene/surface.h"
#include "preprocess/base/file_extension.h"
#include "preprocess/read/scan/missing_attributes.h"

namespace splatray {
namespace {

glm::dvec3 bounds_center(const Scene& scene) {
  return 0.5 * (scene.bounds_min_world + scene.bounds_max_world);
}

void report_progress(const LoadListener& listener, const char* stage, double share) {
  if (listener.progress && !listener.progress(stage, share))
    throw Error(ExitCode::interrupted, "loading was interrupted");
}

ReadOptions reading_of(const Request& request, const Progress& progress) {
  ReadOptions reading = read_options(request.source, progress);
  reading.turn_outwards = !request.look.material.empty() &&
                          (named_material(request.look.material).flags & MATERIAL_DIELECTRIC) != 0;
  return reading;
}

/// Builds the scene of objects whose points are there.
void build(Input input, const Request& request, const LoadListener& listener, const Progress& progress,
           LoadedScene& loaded) {
  const auto report_notes = [&](const std::vector<std::string>& notes) {
    if (listener.note) std::for_each(notes.begin(), notes.end(), listener.note);
  };
  report_notes(input.notes);
  if (request.source.params.ground && request.look.up) input.up = request.look.up;
  BuildStats& stats = loaded.build.emplace();
  loaded.scene =
      build_scene(std::move(input), request.source.params, request.source.threads, stats, progress);
  report_notes(stats.notes);
}

/// Whether a material is another than readers give to points, whose base colour alone depends on them.
bool is_chosen(const Material& material) {
  const Material plain = default_material();
  return material.specular != plain.specular || material.shininess != plain.shininess ||
         material.mirror != plain.mirror || (material.flags & MATERIAL_DIELECTRIC) != 0;
}

constexpr std::string_view SKY = "sky:";

Daylight read_daylight(const std::string& name) {
  const std::string text = name.substr(SKY.size());
  std::vector<double> numbers = split_numbers(text, ',', 2);
  if (numbers.empty()) numbers = split_numbers(text, ',', 3);
  Daylight day;
  if (numbers.size() == 3) day.turbidity = numbers[2];
  if (numbers.empty() || !(numbers[0] > 0.0 && numbers[0] <= 90.0) || !(std::abs(numbers[1]) <= 360.0) ||
      !(day.turbidity >= 2.0 && day.turbidity <= 10.0))
    throw Error(
        ExitCode::usage,
        "--environment: found '" + name +
            "', expected sky:ELEVATION,AZIMUTH[,TURBIDITY] with an elevation above 0 up to 90 degrees, "
            "an azimuth of up to 360 degrees and a turbidity from 2 to 10");
  day.sun_elevation_deg = numbers[0];
  day.sun_azimuth_deg = numbers[1];
  return day;
}

/// Upwards in a picture, or across that where the camera looks straight up or down.
glm::dvec3 up_across(const glm::dvec3& up, const glm::dvec3& view_dir) {
  const glm::dmat3 axes = upright_axes(up);
  return glm::length(glm::cross(axes[1], view_dir)) > 1e-6 * glm::length(view_dir) ? axes[1] : -axes[2];
}

/// The light, as bright as it asks for or else with irradiance pi at the scene's centre.
SceneLight scene_light(const Scene& scene, const LightRequest& light) {
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
SceneLight rectangle_light(const glm::dvec3& up, const LightRequest& light) {
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

/// Lights as a look takes them: LOOK_PAPER, which knows no sizes, has points in place of rectangles, as bright straight ahead.
std::vector<SceneLight> lights_of_look(std::uint32_t look, std::vector<SceneLight> lights) {
  for (SceneLight& light : lights) {
    if (look != LOOK_PAPER || light.kind != LIGHT_RECTANGLE) continue;
    light.kind = LIGHT_POINT;
    light.power *= static_cast<float>(4.0 * glm::length(glm::cross(light.edge_u, light.edge_v)));
  }
  return lights;
}

/// Has occlusion reach as far as suits what a region holds. Throws Error (usage) where that is nothing.
void suit_region(const Scene& scene, Request& request) {
  const Region region = region_of(request.view.region, scene.up);
  if (region.empty()) return;
  const PointSample kept = sample_points(scene, region);
  if (kept.size() == 0)
    throw Error(ExitCode::usage, "the region holds nothing of the scene, whose points lie between " +
                                     number_text(scene.bounds_min_world) + " and " +
                                     number_text(scene.bounds_max_world) +
                                     "; expected boxes and cuts that do");
  double& reach = request.settings.reach_world;
  if (reach == 0.0) reach = REACH_SHARE * diagonal_of(kept);
}

/// Applies --material, --object, --up (else upright of upright.h) and what is shown of attributes, and keeps what suits the
/// scene.
void show_as_asked(const Request& request, LoadedScene& loaded) {
  if (!request.look.material.empty() || !request.look.objects.empty()) {
    ObjectLooks objects = choose_objects(loaded.scene, request);
    loaded.scene.materials = std::move(objects.materials);
    loaded.scene.surfaces = std::move(objects.surfaces);
  }
  loaded.scene.up = request.look.up.value_or(upright(loaded.scene));
  SuitedPicture suited = suited_picture(loaded.scene, request);
  loaded.request = std::move(suited.request);
  loaded.choices = std::move(suited.choices);
  loaded.legend = show_attributes(loaded.scene, loaded.request.look.attributes);
  const bool colors = look_style(choose_look(loaded.scene, loaded.request)).colors;
  place_sheet(loaded.scene, colors ? loaded.legend : ColorLegend{}, loaded.request);
  suit_region(loaded.scene, loaded.request);
  loaded.environment_name = choose_environment_name(loaded.scene, request);
}

/// The camera but for what lens and pixels have.
Camera placed_camera(const Scene& scene, const Request& request) {
  const double aspect = request.view.pixel_aspect * request.view.width / request.view.height;
  if (request.view.eye) {
    const glm::dvec3 target = request.view.target.value_or(bounds_center(scene));
    const auto up = request.view.camera_up ? request.view.camera_up : request.look.up;
    return {*request.view.eye, target, up.value_or(up_across(scene.up, target - *request.view.eye)),
            request.view.fov_y_deg.value_or(DEFAULT_FOV_Y_DEG), request.view.ortho_height};
  }
  // A depth camera's view suits the picture's shape; a model's own camera is its author's.
  if (!scene.camera || !scene.stations.empty() || request.look.up ||
      request.view.viewpoint != Viewpoint::automatic)
    return viewpoint_camera(scene, request.view.viewpoint, aspect, request.view.fov_y_deg,
                            region_of(request.view.region, choose_up(scene, request)));
  Camera camera = *scene.camera;
  camera.fov_y_deg = request.view.fov_y_deg.value_or(camera.fov_y_deg);
  return camera;
}

}  // namespace

LoadedScene load_scene(const Request& request, const LoadListener& listener) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  LoadedScene loaded;
  report_progress(listener, "reading", 0.0);
  const std::vector<std::filesystem::path>& inputs = request.source.inputs;
  require_scene_alone(inputs);
  if (is_scene_file(inputs.front())) {
    if (request.source.params.ground)
      throw Error(ExitCode::usage,
                  "found --ground with a .soct, expected files of points or meshes, or splatray-preprocess "
                  "--ground");
    loaded.scene = read_scene(inputs.front(), listener.progress);
    const std::string missing = missing_attributes(request.source.scans.attributes, loaded.scene.columns);
    if (listener.note && !missing.empty()) listener.note(missing);
  } else {
    const Progress progress = watching_memory(listener.progress);
    ReadOptions reading = reading_of(request, progress);
    reading.points = listener.points;
    build(read_input(inputs, reading), request, listener, progress, loaded);
  }
  loaded.load_ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  show_as_asked(request, loaded);
  return loaded;
}

LoadedScene load_objects(Input input, const Request& request, const LoadListener& listener) {
  LoadedScene loaded;
  const Progress progress = watching_memory(listener.progress);
  finish_objects(input, reading_of(request, progress));
  build(std::move(input), request, listener, progress, loaded);
  show_as_asked(request, loaded);
  return loaded;
}

ObjectLooks choose_objects(const Scene& scene, const Request& request) {
  ObjectLooks objects{scene.materials, surfaces_of(scene)};
  std::vector<ObjectChange> changes;
  if (!request.look.material.empty()) {
    const std::size_t shown = scene.materials.size() - (scene.build.ground ? 1 : 0);
    if (shown != 1)
      throw Error(ExitCode::usage, "found --material with a scene of " + std::to_string(shown) +
                                       " objects, expected one object");
    changes.push_back(read_object_change("0:preset=" + request.look.material));
  }
  changes.insert(changes.end(), request.look.objects.begin(), request.look.objects.end());
  apply_object_changes(changes, scene.object_names, objects);
  return objects;
}

Tone choose_tone(const Request& request) {
  return request.look.tone.value_or(request.look.style == LOOK_PAPER ? Tone::soft : Tone::neutral);
}

Camera choose_camera(const Scene& scene, const Request& request) {
  Camera camera = placed_camera(scene, request);
  camera.lens_shift = request.view.lens_shift;
  camera.pixel_aspect = request.view.pixel_aspect;
  return camera;
}

glm::dvec3 choose_up(const Scene& scene, const Request& request) {
  return request.look.up.value_or(scene.up);
}

std::string choose_environment_name(const Scene& scene, const Request& request) {
  return request.look.environment.empty() ? scene.environment_path : request.look.environment;
}

std::vector<SceneLight> choose_lights(const Scene& scene, const Request& request, const Camera& camera) {
  if (request.look.lights) {
    if (request.look.lights->size() > LIGHTS_MOST)
      throw Error(ExitCode::usage, "found " + std::to_string(request.look.lights->size()) +
                                       " lights in --light and --sun, expected at most " +
                                       std::to_string(LIGHTS_MOST));
    std::vector<SceneLight> lights;
    for (const LightRequest& light : *request.look.lights)
      lights.push_back(light.kind == LIGHT_RECTANGLE ? rectangle_light(choose_up(scene, request), light)
                                                     : scene_light(scene, light));
    return lights_of_look(choose_look(scene, request), std::move(lights));
  }
  return own_lights(scene, !choose_environment_name(scene, request).empty(), choose_look(scene, request),
                    camera);
}

std::vector<SceneLight> own_lights(const Scene& scene, bool environment_named, std::uint32_t look,
                                   const Camera& camera) {
  if (!scene.lights.empty()) return lights_of_look(look, exposed_lights(scene));
  if (environment_named) return {};
  std::vector<SceneLight> lights = default_lights(scene, camera);
  if (look == LOOK_SCAN) lights.front() = scan_light(lights.front());
  return lights;
}

LightRequest light_request(const SceneLight& light) {
  LightRequest asked{light.kind, light.position, light.power};
  asked.size = light.kind == LIGHT_DIRECTIONAL ? light.size * 360.0 / std::numbers::pi : light.size;
  if (light.kind != LIGHT_RECTANGLE) return asked;
  asked.size = 0.0;
  asked.target = light.position + glm::normalize(glm::cross(light.edge_u, light.edge_v));
  asked.edges = 2.0 * glm::dvec2(glm::length(light.edge_u), glm::length(light.edge_v));
  return asked;
}

std::optional<Environment> built_in_environment(const std::string& name) {
  if (name.empty() || name == "studio") return studio_environment();
  if (name == "white") return Environment{0, 0, {}, vec3(1.0F)};
  if (name == "black") return Environment{0, 0, {}, vec3(0.0F)};
  if (name.starts_with(SKY)) return daylight_environment(read_daylight(name));
  const std::vector<double> numbers = split_numbers(name, ',', 3);
  if (numbers.empty()) return {};
  const vec3 radiance(numbers[0], numbers[1], numbers[2]);
  if (!(glm::all(glm::greaterThanEqual(radiance, vec3(0.0F))) &&
        std::isfinite(radiance.x + radiance.y + radiance.z)))
    throw Error(ExitCode::usage,
                "--environment: found '" + name + "', expected a radiance of finite numbers >= 0");
  return Environment{0, 0, {}, radiance};
}

Environment choose_environment(const std::string& name, const std::function<void(const std::string&)>& note) {
  auto environment = built_in_environment(name);
  return environment ? *std::move(environment) : read_environment(name, note);
}

std::uint32_t choose_look(const Scene& scene, const Request& request) {
  if (request.look.style) return *request.look.style;
  const bool plain = scene.lights.empty() && request.look.environment.empty() &&
                     scene.environment_path.empty() && !request.look.lights;
  const bool materials = std::any_of(scene.materials.begin(), scene.materials.end(), is_chosen) ||
                         std::any_of(request.look.objects.begin(), request.look.objects.end(), changes_look);
  return !scene.stations.empty() && plain && !materials ? LOOK_SCAN : LOOK_LIT;
}

Settings choose_settings(const Scene& scene, const Request& request) {
  Settings settings = request.settings;
  settings.region = region_of(request.view.region, choose_up(scene, request));
  settings.look = choose_look(scene, request);
  settings.lens_radius_world = 0.5 * request.view.aperture_world;
  settings.delta_world = request.settings.asked_delta_world.value_or(1e-3 * scene.diagonal_world());
  return settings;
}

}  // namespace splatray
