#include "app/library/shot/scene_on_device.h"

#include "app/library/shot/environment.h"

namespace splatray {

void SceneOnDevice::open(const Scene& scene, Scene* copy, const Tracer::Planned& planned) {
  upload(scene,
         [&] { copy != nullptr ? tracer_.upload_and_free(*copy, planned) : tracer_.upload(scene, planned); });
}

void SceneOnDevice::open_and_free(Scene& scene, const Tracer::Planned& planned) {
  upload(scene, [&] { tracer_.upload_and_free(scene, planned); });
}

void SceneOnDevice::upload(const Scene& scene, const std::function<void()>& pools) {
  take_look(scene);
  try {
    pools();
  } catch (...) {
    scene_ = nullptr;
    throw;
  }
}

void SceneOnDevice::replace_pools(Scene& copy) { tracer_.upload_and_free(copy); }

void SceneOnDevice::take_look(const Scene& scene) {
  auto environment = std::move(look_.environment);
  look_ = look_of(scene);
  look_.environment = std::move(environment);
  scene_ = &scene;
}

void SceneOnDevice::show_environment(const std::string& name,
                                     const std::function<void(const std::string&)>& note) {
  if (environment_ == name) return;
  environment_ = name;
  look_.environment = std::make_shared<const Environment>(load_environment(name, note));
}

}  // namespace splatray
