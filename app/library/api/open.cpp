#include "app/library/api/arrays.h"
#include "app/library/api/guard.h"
#include "app/library/api/request_impl.h"
#include "app/library/api/scene_impl.h"
#include "engine/base/one_line.h"
#include "engine/scene/wide/wide_tree.h"

namespace splatray::api {
namespace {

/// The objects, and after them what they look like.
Input input_of(std::span<const Object> objects, splatray::Request& request) {
  Input input;
  input.up = request.look.up ? glm::normalize(*request.look.up) : glm::dvec3(0.0, 0.0, 1.0);
  std::vector<ObjectChange> materials;
  for (const Object& object : objects)
    std::visit(
        [&](const auto& given) {
          if (given.material)
            materials.push_back(object_change(std::to_string(input.objects.size()), *given.material));
          input.objects.push_back(input_object(given));
        },
        object);
  request.look.objects.insert(request.look.objects.begin(), materials.begin(), materials.end());
  return input;
}

}  // namespace

Scene open(std::span<const std::filesystem::path> files, const Request& asked, const Progress& progress) {
  return guarded(progress, [&](ProgressRelay& relay) {
    splatray::Request request = RequestAccess::inner(asked);
    if (files.empty()) refuse("no file", "at least one");
    if (!request.source.lod) request.source.lod = 0.0;  // who traces rays expects all of a scan
    request.source.inputs.assign(files.begin(), files.end());
    require_inputs(request.source);
    auto impl = std::make_shared<Scene::Impl>();
    const LoadListener listener{std::ref(relay),
                                [&](const std::string& note) { impl->notes.push_back(note); }};
    impl->loaded = load_scene(request, listener);
    // Who traces rays is told each one's splat, which is found by the tree that older files are without.
    if (!has_wide_tree(impl->loaded.scene)) add_wide_tree(impl->loaded.scene, request.source.threads);
    impl->asked = std::move(request);
    return SceneAccess::make(std::move(impl));
  });
}

Scene open(const std::filesystem::path& file, const Request& request, const Progress& progress) {
  return open(std::span(&file, 1), request, progress);
}

Scene make_scene(std::span<const Object> objects, const Request& asked, const Progress& progress) {
  return guarded(progress, [&](ProgressRelay& relay) {
    splatray::Request request = RequestAccess::inner(asked);
    Input input = input_of(objects, request);
    auto impl = std::make_shared<Scene::Impl>();
    const LoadListener listener{std::ref(relay),
                                [&](const std::string& note) { impl->notes.push_back(one_line(note)); }};
    impl->loaded = load_objects(std::move(input), request, listener);
    impl->asked = std::move(request);
    if (const std::uint64_t dropped = impl->loaded.build->dropped_non_finite; dropped > 0)
      impl->notes.push_back(std::to_string(dropped) + " points that are not finite were left out");
    for (const Object& object : objects) impl->has_points.push_back(std::holds_alternative<Points>(object));
    return SceneAccess::make(std::move(impl));
  });
}

Scene make_scene(const Points& object, const Request& request, const Progress& progress) {
  const Object one = object;
  return make_scene(std::span(&one, 1), request, progress);
}

Scene make_scene(const Mesh& object, const Request& request, const Progress& progress) {
  const Object one = object;
  return make_scene(std::span(&one, 1), request, progress);
}

}  // namespace splatray::api
