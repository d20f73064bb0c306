/// What a Scene of the interface holds.
#pragma once
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "app/library/api/device.h"
#include "app/library/scene_source.h"
#include "app/library/splatray.h"
#include "engine/gpu/tracer.h"

namespace splatray::api {

/// The column that keeps which of an object's Points a splat was.
inline constexpr std::string_view COLUMN_POINT = "point";

struct Scene::Impl {
  LoadedScene loaded;
  std::vector<std::string> notes;
  std::string device_wanted;
  std::filesystem::path cache;

  /// Calls use(tracer), with the device to itself.
  template <typename Use>
  auto with_tracer(const Use& use) {
    open_device();
    const std::lock_guard lock(device->turn);
    return use(*tracer);
  }
  /// The device's name.
  [[nodiscard]] std::string device_name();
  /// Gives the tracer the environment of this name; the device must be this thread's.
  void show_environment(const std::string& name);

  Impl() = default;
  ~Impl();
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

 private:
  void open_device();

  std::mutex opening;
  std::shared_ptr<SharedDevice> device;
  std::unique_ptr<Tracer> tracer;
  std::optional<std::string> environment_shown;
};

/// Makes scenes, and looks into them.
struct SceneAccess {
  [[nodiscard]] static Scene make(std::unique_ptr<Scene::Impl> impl) { return Scene(std::move(impl)); }
  /// Throws Error (usage) for a scene that was moved from.
  [[nodiscard]] static Scene::Impl& impl(const Scene& scene);
};

[[nodiscard]] inline glm::dvec3 vector(const Double3& v) { return {v[0], v[1], v[2]}; }
[[nodiscard]] inline glm::vec3 vector(const Float3& v) { return {v[0], v[1], v[2]}; }
[[nodiscard]] inline Double3 array(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
[[nodiscard]] inline Float3 array(const glm::vec3& v) { return {v.x, v.y, v.z}; }

/// `material` with what the interface's says; what that knows nothing of stays.
[[nodiscard]] splatray::Material changed(splatray::Material material, const Material& to);
[[nodiscard]] Material described(const splatray::Material& material);

}  // namespace splatray::api
