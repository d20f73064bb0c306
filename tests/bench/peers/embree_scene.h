/// Embree's handles, and rays in its words.
#pragma once
#include <embree3/rtcore.h>

#include <atomic>
#include <memory>
#include <span>
#include <type_traits>

#include "shaders/layout.h"

namespace splatray::testing {

/// A device with one scene.
class EmbreeScene {
 public:
  /// With this quality of the hierarchy.
  explicit EmbreeScene(RTCBuildQuality quality = RTC_BUILD_QUALITY_MEDIUM);

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

/// Up to WIDTH rays (8 or 16) from t_min to infinity that have hit nothing; a ray's id is its place in the bundle.
template <unsigned WIDTH>
struct EmbreeBundle {
  explicit EmbreeBundle(std::span<const RayQuery> rays);
  void intersect(RTCScene scene, RTCIntersectContext& context);
  /// 1 for each ray that anything lies on.
  void occluded(RTCScene scene, RTCIntersectContext& context, std::span<std::uint8_t> blocked);

  alignas(64) int valid[WIDTH];
  std::conditional_t<WIDTH == 8, RTCRayHit8, RTCRayHit16> query;
};

/// Sets 1 for each ray that anything lies on, else 0; `width` rays (1, 8 or 16) in a call.
void find_occluded(RTCScene scene, unsigned width, RTCIntersectContextFlags flags,
                   std::span<const RayQuery> rays, std::span<std::uint8_t> blocked);

}  // namespace splatray::testing
