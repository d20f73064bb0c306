#include "tests/bench/cases/prepare.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "app/library/image_file.h"
#include "app/library/materials.h"
#include "data/models.h"
#include "engine/file/scene_file.h"
#include "engine/scene/splat.h"
#include "preprocess/build.h"
#include "tests/bench/cases/case_file.h"
#ifdef SPLATRAY_EMBREE
#include "tests/bench/truth/mesh_truth.h"
#endif
#include "tests/trace/scenes.h"

namespace splatray::testing {
namespace {

Material mirror_one_sided() {
  Material material = named_material("mirror");
  material.flags = 0;
  return material;
}

Material material_of(const Case& one) {
  switch (one.measure) {
    case Measure::leaks:
      return named_material("glass");
    case Measure::ball:
    case Measure::wedge:
      return mirror_one_sided();
    default:
      return default_material();
  }
}

Input input_of_model(const Case& one, const Variant& variant) {
  const Model model = models().at(one.source)({.angle_deg = one.wedge_deg});
  auto clouds = sample(model, {.count = variant.points, .even = variant.even});
  OrientedPoints points = std::move(clouds.begin()->second);
  if (one.measure == Measure::ball) points = flipped(std::move(points));
  Input input;
  InputObject& object = input.objects.emplace_back();
  object.name = one.source;
  object.points.position = std::move(points.position);
  object.points.normal.assign(points.normal.begin(), points.normal.end());
  object.material = material_of(one);
  object.oriented = true;
  for (const SurfacePatch& surface : model) object.surface_area += surface.area;
  return input;
}

/// Points of the scenes whose models are our own.
void generate_points(const Case& one, const Variant& variant, const std::filesystem::path& folder) {
  if (one.source.find("room") != std::string::npos) write_model("room", variant.points, folder);
}

Input input_of_file(const Case& one, const Variant& variant, const Folders& folders) {
  ReadOptions options;
  if (one.origin == Origin::mesh) {
    options.samples = variant.points;
    options.clip = variant.build.clip;
    options.keep_meshes = true;
    return read_input({folders.data / one.source}, options);
  }
  const std::filesystem::path points = folders.output / "points";
  generate_points(one, variant, points);
  options.data_paths = {points, folders.data};
  return read_input({folders.repository / one.source}, options);
}

/// The camera moved nearer or its lens made longer until the model fills `share` of the picture's height.
Camera fitted_camera(const Scene& scene, double share) {
  Camera camera = framing_camera(scene, 1.0);
  const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
  const glm::dvec3 up = glm::cross(glm::normalize(glm::cross(forward, camera.up)), forward);
  double highest = 0.0;
  for (const uvec4& words : scene.data_pool) {
    const glm::dvec3 from_eye = scene.root.to_world(unpack_splat(words).center) - camera.eye;
    highest = std::max(highest, std::abs(glm::dot(from_eye, up)) / glm::dot(from_eye, forward));
  }
  camera.fov_y_deg = 2.0 * std::atan(highest / share) * 180.0 / std::numbers::pi;
  return camera;
}

/// Light and surroundings as splatray-render shows a scene that names them or does not.
void choose_light(Scene& scene, const Camera& camera, const std::filesystem::path& folder) {
  const bool named = !scene.environment_path.empty();
  write_environment(named ? read_environment(scene.environment_path) : studio_environment(),
                    folder / "environment.bin");
  if (!scene.lights.empty()) {
    // Programs expose the picture; here the lights are what suits it.
    const auto factor = static_cast<float>(std::numbers::pi / own_light_level(scene));
    for (SceneLight& light : scene.lights) light.power *= factor;
  } else if (!named) {
    scene.lights = default_lights(scene, camera);
  }
  scene.environment_path.clear();
}

/// Writes truth.bin and returns its name; nothing for cases that are measured without.
std::string write_truth_of(const Case& one, const View& view,
                           [[maybe_unused]] const std::vector<Mesh>& meshes,
                           const std::filesystem::path& path) {
  if (one.measure != Measure::picture) return "";
  if (one.shape) {
    write_truth(analytic_truth(*one.shape, view), path);
    return "analytic";
  }
#ifdef SPLATRAY_EMBREE
  write_truth(mesh_truth(meshes.front(), view), path);
#endif
  return "mesh";
}

}  // namespace

std::string reason_to_leave_out(const Case& one, const Folders& folders) {
  const bool own_points = one.source == "data/scenes/room.gltf";
  if (one.origin != Origin::model && !own_points && folders.data.empty())
    return "SPLATRAY_DATA_DIR is not set";
#ifndef SPLATRAY_EMBREE
  if (one.origin == Origin::mesh) return "built without Embree (libembree-dev)";
#endif
  return "";
}

void prepare_case(const Case& one, const Folders& folders) {
  const std::filesystem::path folder = folders.output / folder_name(one);
  std::filesystem::create_directories(folder);
  PreparedCase prepared;
  for (const Variant& variant : variants_of(one)) {
    Input input =
        one.origin == Origin::model ? input_of_model(one, variant) : input_of_file(one, variant, folders);
    const std::vector<Mesh> meshes = std::move(input.objects.front().meshes);
    BuildStats stats;
    Scene scene = build_scene(std::move(input), variant.build, 0, stats);
    if (prepared.variants.empty()) {
      prepared.camera = one.fill > 0.0 ? fitted_camera(scene, one.fill) : default_camera(scene, 1.0);
      prepared.diagonal_world = scene.diagonal_world();
      prepared.truth =
          write_truth_of(one, {prepared.camera, one.width, one.height}, meshes, folder / "truth.bin");
    }
    choose_light(scene, prepared.camera, folder);
    write_scene(scene, folder / file_name(variant));
    prepared.variants[file_name(variant)] = {stats.total_ms / 1000.0, stats.overlap,
                                             stats.radius_median_world};
  }
  write_case(prepared, folder);
}

}  // namespace splatray::testing
