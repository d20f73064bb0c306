#include <algorithm>
#include <cmath>
#include <numeric>

#include "app/library/api/guard.h"
#include "app/library/api/scene_impl.h"
#include "engine/base/memory.h"
#include "preprocess/base/file_extension.h"

namespace splatray::api {
namespace {

void check(const OpenOptions& options) {
  constexpr double LEAST = 1e-6, MOST = 1e6;
  constexpr std::uint64_t MOST_POINTS = 1ULL << 32;
  constexpr unsigned MOST_THREADS = 4096;
  if (!(options.radius_scale >= LEAST && options.radius_scale <= MOST))
    refuse("radius_scale " + std::to_string(options.radius_scale), "1e-6 to 1e6");
  if (options.mesh_points >= MOST_POINTS)
    refuse("mesh_points " + std::to_string(options.mesh_points), "less than 2^32");
  if (options.threads > MOST_THREADS) refuse("threads " + std::to_string(options.threads), "at most 4096");
  if (!options.up) return;
  const double length = glm::length(vector(*options.up));
  if (!(std::isfinite(length) && length > 0.0))
    refuse("an up direction of length " + std::to_string(length), "a finite one above 0");
}

Request::Source scene_options(const OpenOptions& options) {
  Request::Source scene;
  scene.params.radius_scale = options.radius_scale;
  scene.params.samples = options.mesh_points;
  scene.data_paths = options.data;
  scene.threads = options.threads;
  return scene;
}

/// What is asked of a picture when the scene is loaded.
Request request_options(const OpenOptions& options) {
  Request request;
  if (options.up) request.look.up = glm::normalize(vector(*options.up));
  request.look.attributes.color_by = options.color_by;
  return picture;
}

std::shared_ptr<Scene::Impl> new_scene(const OpenOptions& options) {
  auto impl = std::make_shared<Scene::Impl>();
  impl->device_wanted = options.device;
  impl->cache = options.cache;
  impl->threads = options.threads;
  return impl;
}

/// An array in the type that preprocess works on.
template <typename To, typename From>
std::vector<To> copied(const std::span<const From>& values) {
  std::vector<To> list(values.size());
  std::transform(values.begin(), values.end(), list.begin(), [](const From& v) { return vector(v); });
  return list;
}

void check_sizes(const Points& points) {
  const auto check = [&](const char* name, std::size_t size) {
    if (size != 0 && size != points.positions.size())
      refuse(std::to_string(size) + " " + name,
             "none or as many as the " + std::to_string(points.positions.size()) + " positions");
  };
  check("normals", points.normals.size());
  check("colors", points.colors.size());
  check("radii", points.radii.size());
}

InputObject input_object(const Points& points) {
  check_sizes(points);
  InputObject object;
  object.name = points.name;
  object.measured = points.scanned.value_or(points.normals.empty());
  object.material = default_material();
  if (!points.colors.empty()) object.material.diffuse = COLORED_DIFFUSE;
  if (points.material) object.material = changed(object.material, *points.material);
  object.points.position = copied<glm::dvec3>(points.positions);
  object.points.normal = copied<glm::vec3>(points.normals);
  object.points.color = copied<glm::vec3>(points.colors);
  object.points.radius.assign(points.radii.begin(), points.radii.end());
  std::vector<double> number(points.positions.size());
  std::iota(number.begin(), number.end(), 0.0);
  object.points.columns.push_back({std::string(COLUMN_POINT), std::move(number)});
  return object;
}

}  // namespace

Scene open(std::span<const std::filesystem::path> files, const OpenOptions& options) {
  return guarded(request.output.progress, [&](ProgressRelay& relay) {
    check(options);
    if (files.empty()) refuse("no file", "at least one");
    for (const std::filesystem::path& file : files)
      if (files.size() > 1 && lower_extension(file) == ".soct")
        refuse("a .soct beside other files", "it alone");
    Request::Source scene = scene_options(options);
    scene.inputs.assign(files.begin(), files.end());
    auto impl = new_scene(options);
    const LoadListener listener{std::ref(relay),
                                [&](const std::string& note) { impl->notes.push_back(note); }};
    impl->loaded = load_scene(scene, picture_options(options), listener);
    return SceneAccess::make(std::move(impl));
  });
}

Scene open(const std::filesystem::path& file, const OpenOptions& options) {
  return open(std::span(&file, 1), options);
}

Scene make_scene(std::span<const Points> objects, const OpenOptions& options) {
  return guarded(request.output.progress, [&](ProgressRelay& relay) {
    check(options);
    Input input;
    input.up = glm::dvec3(0.0, 0.0, 1.0);
    if (options.up) input.up = glm::normalize(vector(*options.up));
    for (const Points& object : objects) input.objects.push_back(input_object(object));
    auto impl = new_scene(options);
    const Request::Source scene = scene_options(options);
    BuildStats& stats = impl->loaded.build.emplace();
    impl->loaded.scene =
        build_scene(std::move(input), scene.params, scene.threads, stats, watching_memory(std::ref(relay)));
    impl->loaded.legend = show_attributes(impl->loaded.scene, picture_options(options).attributes);
    if (stats.dropped_non_finite > 0)
      impl->notes.push_back(std::to_string(stats.dropped_non_finite) +
                            " points that are not finite were left out");
    impl->notes.insert(impl->notes.end(), stats.notes.begin(), stats.notes.end());
    return SceneAccess::make(std::move(impl));
  });
}

Scene make_scene(const Points& object, const OpenOptions& options) {
  return make_scene(std::span(&object, 1), options);
}

}  // namespace splatray::api
