#include <algorithm>
#include <numeric>

#include "app/library/api/guard.h"
#include "app/library/api/request_impl.h"
#include "app/library/api/scene_impl.h"
#include "engine/base/memory.h"

namespace splatray::api {
namespace {

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

Scene open(std::span<const std::filesystem::path> files, const Request& asked, const Progress& progress) {
  return guarded(progress, [&](ProgressRelay& relay) {
    splatray::Request request = RequestAccess::inner(asked);
    if (files.empty()) refuse("no file", "at least one");
    request.source.inputs.assign(files.begin(), files.end());
    require_inputs(request.source);
    auto impl = std::make_shared<Scene::Impl>();
    const LoadListener listener{std::ref(relay),
                                [&](const std::string& note) { impl->notes.push_back(note); }};
    impl->loaded = load_scene(request, listener);
    return SceneAccess::make(std::move(impl));
  });
}

Scene open(const std::filesystem::path& file, const Request& request, const Progress& progress) {
  return open(std::span(&file, 1), request, progress);
}

Scene make_scene(std::span<const Points> objects, const Request& asked, const Progress& progress) {
  return guarded(progress, [&](ProgressRelay& relay) {
    splatray::Request request = RequestAccess::inner(asked);
    Input input;
    input.up = request.look.up ? glm::normalize(*request.look.up) : glm::dvec3(0.0, 0.0, 1.0);
    std::vector<ObjectChange> materials;
    for (const Points& object : objects) {
      if (object.material)
        materials.push_back(object_change(std::to_string(input.objects.size()), *object.material));
      input.objects.push_back(input_object(object));
    }
    request.look.objects.insert(request.look.objects.begin(), materials.begin(), materials.end());
    auto impl = std::make_shared<Scene::Impl>();
    BuildStats& stats = impl->loaded.build.emplace();
    impl->loaded.scene = build_scene(std::move(input), request.source.params, request.source.threads, stats,
                                     watching_memory(std::ref(relay)));
    if (stats.dropped_non_finite > 0)
      impl->notes.push_back(std::to_string(stats.dropped_non_finite) +
                            " points that are not finite were left out");
    impl->notes.insert(impl->notes.end(), stats.notes.begin(), stats.notes.end());
    show_as_asked(request, impl->loaded);
    return SceneAccess::make(std::move(impl));
  });
}

Scene make_scene(const Points& object, const Request& request, const Progress& progress) {
  return make_scene(std::span(&object, 1), request, progress);
}

}  // namespace splatray::api
