/// A scene on a device, and the look it is shown in: what programs, viewer and library trace.
#pragma once
#include <optional>
#include <string>

#include "engine/gpu/tracer.h"

namespace splatray {

/// For one thread at a time.
class SceneOnDevice {
 public:
  /// The device must outlive it.
  explicit SceneOnDevice(const Device& device, const TracerOptions& options = {})
      : device_(device), tracer_(device, options) {}

  /// Uploads a scene, which must outlive its stay here, and shows it in its own look; instead of its pools those of a copy with
  /// other colours and radii, if there is one, and frees them. `planned`: as Tracer::upload has it; the scene is open then. Throws Error.
  void open(const Scene& scene, Scene* copy = nullptr, const Tracer::Planned& planned = {});
  /// As open, but frees the scene's pools, each as soon as it is on the device; all else of the scene stays.
  void open_and_free(Scene& scene, const Tracer::Planned& planned = {});
  /// Uploads other pools of the scene opened, and frees them: those of a copy, as in open.
  void replace_pools(Scene& copy);
  [[nodiscard]] bool is_open() const { return scene_ != nullptr; }

  /// Shows other materials; the scene has its pools.
  void show_materials(std::vector<Material> materials) {
    splatray::show_materials(*scene_, std::move(materials), look_);
  }
  /// Shows the environment of a name, as load_environment has it. Throws Error (input_unreadable), once: the one before stays.
  /// `note` hears of what is odd in its file.
  void show_environment(const std::string& name, const std::function<void(const std::string&)>& note = {});
  void show_lights(std::vector<SceneLight> lights) { look_.lights = std::move(lights); }
  void show_up(const glm::dvec3& up) { look_.up = up; }

  /// After open_and_free only its small parts are there.
  [[nodiscard]] const Scene& scene() const { return *scene_; }
  [[nodiscard]] const Look& look() const { return look_; }
  [[nodiscard]] Tracer& tracer() { return tracer_; }
  [[nodiscard]] const Device& device() const { return device_; }

 private:
  void take_look(const Scene& scene);
  void upload(const Scene& scene, const std::function<void()>& pools);

  const Device& device_;
  Tracer tracer_;
  const Scene* scene_ = nullptr;
  Look look_;
  std::optional<std::string> environment_;  ///< the name of the look's
};

}  // namespace splatray
