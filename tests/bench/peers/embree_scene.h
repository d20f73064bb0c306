/// Embree's handles, and rays in its words.
#pragma once
#include <embree3/rtcore.h>

#include <atomic>
#include <memory>
#include <span>

#include "shaders/layout.h"

namespace splatray::testing {

/// A device with one scene.
class EmbreeScene {
 public:
  EmbreeScene();

  [[nodiscard]] RTCDevice device() const { return device_.get(); }
  [[nodiscard]] RTCScene scene() const { return scene_.get(); }
  /// Commits the geometry and then the scene, with this geometry alone. Throws Error (out_of_memory) when Embree could not.
  void build(RTCGeometry geometry);
  /// Memory that the device holds.
  [[nodiscard]] std::uint64_t bytes() const { return static_cast<std::uint64_t>(bytes_.load()); }

 private:
  static bool count_bytes(void* self, ssize_t bytes, bool after);

  std::atomic<std::int64_t> bytes_ = 0;  ///< outlives the device
  std::unique_ptr<RTCDeviceTy, decltype(&rtcReleaseDevice)> device_;
  std::unique_ptr<RTCSceneTy, decltype(&rtcReleaseScene)> scene_;
};

/// A ray from t_min to infinity that has hit nothing.
[[nodiscard]] RTCRayHit embree_ray(const RayQuery& query);

/// Up to eight rays from t_min to infinity that have hit nothing; a ray's id is its place in the bundle.
struct EmbreeBundle {
  explicit EmbreeBundle(std::span<const RayQuery> rays);
  void intersect(RTCScene scene, RTCIntersectContext& context) {
    rtcIntersect8(valid, scene, &context, &query);
  }
  /// 1 for each ray that anything lies on.
  void occluded(RTCScene scene, RTCIntersectContext& context, std::span<std::uint8_t> blocked) {
    rtcOccluded8(valid, scene, &context, &query.ray);
    for (std::size_t lane = 0; lane < blocked.size(); ++lane)
      blocked[lane] = query.ray.tfar[lane] < 0.0F ? 1 : 0;
  }

  alignas(32) int valid[8];
  RTCRayHit8 query;
};

}  // namespace splatray::testing
