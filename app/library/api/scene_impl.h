/// What a Scene of the interface holds.
#pragma once
#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/library/api/device.h"
#include "app/library/picture/scene_source.h"
#include "app/library/request/object_change.h"
#include "app/library/splatray.h"
#include "engine/gpu/tracer.h"

namespace splatray::api {

/// The column that keeps which of an object's Points a splat was.
inline constexpr std::string_view COLUMN_POINT = "point";

/// A scene on its device. All but `device` belong to whose turn it is.
struct SceneOnDevice {
  std::shared_ptr<SharedDevice> device;
  std::unique_ptr<Tracer> tracer{};
  Look look{};                               ///< of the last picture
  std::optional<std::string> environment{};  ///< the name of its environment
  bool in_use = false;

  /// Makes the look's environment the one of this name.
  void show_environment(const std::string& name);
};

struct Scene::Impl {
  LoadedScene loaded;
  std::vector<std::string> notes;
  /// By object, whether it was made of Points, which COLUMN_POINT numbers; empty: none was.
  std::vector<bool> has_points{};

  /// Calls use(scene on its device), with the device to itself; asks `relay` while it waits for that. Throws Error (usage) where
  /// that is what the progress function of such a use does.
  template <typename Use>
  auto on_device(ProgressRelay& relay, const Use& use) {
    const std::shared_ptr<SceneOnDevice> there = open_device();
    const Turn turn(*there->device, relay);
    const InUse in_use(*this, *there);
    return use(*there);
  }
  /// The device's name; opens it.
  [[nodiscard]] std::string device_name();

  Impl() = default;
  ~Impl();
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

 private:
  /// Puts the scene on the device where it is not yet, and keeps others from it.
  class InUse {
   public:
    InUse(const Impl& scene, SceneOnDevice& there);
    ~InUse() { there_.in_use = false; }
    InUse(const InUse&) = delete;
    InUse& operator=(const InUse&) = delete;

   private:
    SceneOnDevice& there_;
  };
  [[nodiscard]] std::shared_ptr<SceneOnDevice> open_device();

  std::atomic<std::shared_ptr<SceneOnDevice>> there_;  ///< null until it is needed
};

/// Makes scenes, and looks into them.
struct SceneAccess {
  [[nodiscard]] static Scene make(std::shared_ptr<Scene::Impl> impl) { return Scene(std::move(impl)); }
  /// What the scene holds; long work keeps it, as its progress function may end the scene. Throws Error (usage) for a scene that
  /// was moved from.
  [[nodiscard]] static const std::shared_ptr<Scene::Impl>& impl(const Scene& scene);
};

[[nodiscard]] inline glm::dvec3 vector(const Double3& v) { return {v[0], v[1], v[2]}; }
[[nodiscard]] inline glm::vec3 vector(const Float3& v) { return {v[0], v[1], v[2]}; }
[[nodiscard]] inline Double3 array(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
[[nodiscard]] inline Float3 array(const glm::vec3& v) { return {v.x, v.y, v.z}; }

/// The change that makes an object's material this one. Throws splatray::Error (usage) for what is out of range.
[[nodiscard]] ObjectChange object_change(const std::string& object, const Material& material);
[[nodiscard]] Material described(const splatray::Material& material);

}  // namespace splatray::api
