/// Rays that go on from hits, traced segment by segment, so that a test sees every hit of a path.
#pragma once
#include <cstddef>
#include <functional>
#include <vector>

#include "tests/hard/support/device_scene.h"

namespace splatray::testing {

/// Rays and their hits, beside each other.
struct Segment {
  std::vector<RayQuery> rays;
  std::vector<RayHit> hits;
};

/// Calls `each(first, count)` for consecutive ranges that make up [0, total), each of at most 2^18.
void in_batches(std::size_t total, const std::function<void(std::size_t first, std::size_t count)>& each);

/// Traces the rays.
[[nodiscard]] Segment traced(DeviceScene& device, std::vector<RayQuery> rays, const Settings& settings = {});

/// Whether the first splat's front was hit.
[[nodiscard]] bool is_front(const RayQuery& ray, const RayHit& hit);

/// The segment's rays that hit, mirrored as the shaders mirror them. `index`, beside the segment's rays,
/// loses the entries of those that missed.
[[nodiscard]] std::vector<RayQuery> mirrored_rays(const Segment& segment, std::vector<std::size_t>& index);

/// The segment's rays that hit, refracted by the scene's dielectrics (or reflected where all is); `index` as
/// in mirrored_rays.
[[nodiscard]] std::vector<RayQuery> refracted_rays(const Scene& scene, const Segment& segment,
                                                   std::vector<std::size_t>& index);

/// 0, 1, ..., count - 1.
[[nodiscard]] std::vector<std::size_t> indices(std::size_t count);

}  // namespace splatray::testing
