#include "app/library/api/guard.h"
#include "app/library/api/scene_impl.h"
#include "engine/file/file_roles.h"
#include "engine/file/scene_file.h"
#include "engine/scene/scene_splat.h"

namespace splatray::api {

Scene::Scene(std::shared_ptr<Impl> impl) : impl_(std::move(impl)) {}
Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

const std::shared_ptr<Scene::Impl>& SceneAccess::impl(const Scene& scene) {
  if (!scene.impl_) refuse("a scene that was moved from", "one that holds something");
  return scene.impl_;
}

Scene::Impl::~Impl() {
  const std::shared_ptr<Place> place = place_.load();
  if (!place || !place->scene) return;
  if (place->device->is_of_parent()) {
    keep_for_good(place);
  } else {
    place->device->drop(std::move(place->scene));
  }
}

std::shared_ptr<Place> Scene::Impl::open_device() {
  std::shared_ptr<Place> place = place_.load();
  if (place && !place->device->is_of_parent()) return place;
  auto opened = std::make_shared<Place>(Place{shared_device(asked.settings.device)});
  if (place) keep_for_good(place);
  return place_.compare_exchange_strong(place, opened) ? opened : place;
}

Scene::Impl::InUse::InUse(const Impl& scene, Place& place) : place_(place) {
  if (place.in_use)
    refuse("a progress function that uses the scene whose work it hears of",
           "other scenes there, or this one afterwards");
  if (!place.scene) {
    auto shown = std::make_unique<SceneOnDevice>(
        *place.device->device,
        TracerOptions{.pipeline_folder = scene.asked.settings.cache, .threads = scene.asked.source.threads});
    shown->open(scene.loaded.scene);
    place.scene = std::move(shown);
  }
  place.in_use = true;
}

std::string Scene::Impl::device_name() { return open_device()->device->device->info().name; }

std::size_t Scene::splats() const { return splat_count(SceneAccess::impl(*this)->loaded.scene); }

Double3 Scene::bounds_low() const { return array(SceneAccess::impl(*this)->loaded.scene.bounds_min_world); }
Double3 Scene::bounds_high() const { return array(SceneAccess::impl(*this)->loaded.scene.bounds_max_world); }

Double3 Scene::up() const { return array(glm::normalize(SceneAccess::impl(*this)->loaded.scene.up)); }

std::vector<std::string> Scene::objects() const {
  return SceneAccess::impl(*this)->loaded.scene.object_names;
}

std::vector<Material> Scene::materials() const {
  std::vector<Material> materials;
  for (const splatray::Material& material : SceneAccess::impl(*this)->loaded.scene.materials)
    materials.push_back(described(material));
  return materials;
}

const std::vector<std::string>& Scene::notes() const { return SceneAccess::impl(*this)->notes; }

std::string Scene::device() const {
  return guarded([&] { return SceneAccess::impl(*this)->device_name(); });
}

Scene::Splat Scene::splat(std::size_t index) const {
  const splatray::Scene& scene = SceneAccess::impl(*this)->loaded.scene;
  if (index >= splat_count(scene))
    refuse("splat " + std::to_string(index), "a number below " + std::to_string(splat_count(scene)));
  const SceneSplat splat = splat_at(scene, index);
  return {array(splat.center_world()), array(splat.normal()), splat.radius_world(), splat.object()};
}

void Scene::save(const std::filesystem::path& file, const Progress& progress) const {
  guarded(progress, [&](ProgressRelay& relay) {
    const std::shared_ptr<Impl> impl = SceneAccess::impl(*this);
    require_no_input(file);
    write_scene(impl->loaded.scene, file, std::ref(relay));
  });
}

}  // namespace splatray::api
