/// What a Scene of the interface holds.
#pragma once
#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/library/api/device.h"
#include "app/library/request/object_change.h"
#include "app/library/shot/scene_on_device.h"
#include "app/library/shot/scene_source.h"
#include "app/library/splatray.h"

namespace splatray::api {

/// The column that keeps which of an object's Points a splat was.
inline constexpr std::string_view COLUMN_POINT = "point";

/// A scene's place on a device. All but `device` belong to whose turn it is.
struct Place {
  std::shared_ptr<SharedDevice> device;
  std::unique_ptr<SceneOnDevice> scene{};
  bool in_use = false;
};

struct Scene::Impl {
  LoadedScene loaded;
  splatray::Request asked{};  ///< by whom opened it
  std::vector<std::string> notes;
  /// By object, whether it was made of Points, which COLUMN_POINT numbers; empty: none was.
  std::vector<bool> has_points{};

  /// Calls use(scene on its device), with the device to itself; asks `relay` while it waits for that. Throws Error (usage) where
  /// that is what the progress function of such a use does.
  template <typename Use>
  auto on_device(ProgressRelay& relay, const Use& use) {
    const std::shared_ptr<Place> place = open_device();
    const Turn turn(*place->device, relay);
    const InUse in_use(*this, *place);
    return use(*place->scene);
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
    InUse(const Impl& scene, Place& place);
    ~InUse() { place_.in_use = false; }
    InUse(const InUse&) = delete;
    InUse& operator=(const InUse&) = delete;

   private:
    Place& place_;
  };
  [[nodiscard]] std::shared_ptr<Place> open_device();

  std::atomic<std::shared_ptr<Place>> place_;  ///< null until it is needed
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
[[nodiscard]] inline bool finite(const Double3& v) {
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}
/// The unit vector along v, whatever its length; zero where that is.
[[nodiscard]] inline glm::dvec3 unit(const Double3& v) {
  const double largest = std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
  return largest > 0.0 ? glm::normalize(vector(v) / largest) : glm::dvec3(0.0);
}
[[nodiscard]] inline Double3 array(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
[[nodiscard]] inline Float3 array(const glm::vec3& v) { return {v.x, v.y, v.z}; }

/// The change that makes an object's material this one. Throws splatray::Error (usage) for what is out of range.
[[nodiscard]] ObjectChange object_change(const std::string& object, const Material& material);
[[nodiscard]] Material described(const splatray::Material& material);

}  // namespace splatray::api
