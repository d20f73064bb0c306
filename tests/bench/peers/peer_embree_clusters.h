/// Groups of discs as Embree's user geometry.
#pragma once
#include "tests/bench/peers/embree_scene.h"
#include "tests/bench/peers/peer.h"
#include "tests/bench/peers/peer_discs.h"

namespace splatray::testing {

/// RTC_GEOMETRY_TYPE_USER: each primitive is `group` discs that lie together, in their tightest box: halves of the
/// discs along the longest side, again and again, each but the last a multiple of `group`. All are tested in one vectorised loop, one ray at a time. A group of 1 is a disc of its own. Hits are gathered as the
/// discs are tested, without a filter.
class EmbreeClusters : public Peer {
 public:
  /// Most discs of a group.
  static constexpr std::size_t GROUP_MOST = 64;

  /// `discs` must outlive the peer; `group` in 1..GROUP_MOST.
  EmbreeClusters(const Discs& discs, const Settings& settings, std::size_t group,
                 RTCBuildQuality quality = RTC_BUILD_QUALITY_MEDIUM);
  void trace(std::span<const RayQuery> rays, std::span<RayHit> hits) const override;
  void occluded(std::span<const RayQuery> rays, std::span<std::uint8_t> blocked) const override;
  [[nodiscard]] std::uint64_t bytes() const override;

 private:
  static void bounds_of(const RTCBoundsFunctionArguments* args);
  static void intersect(const RTCIntersectFunctionNArguments* args);
  static void occlude(const RTCOccludedFunctionNArguments* args);
  /// Calls visit(disc, t) for each disc of a primitive that the ray meets.
  template <class Visit>
  void visit_meetings(unsigned primitive, const RTCRay& ray, const Visit& visit) const;

  const Discs& discs_;
  Settings settings_;
  std::size_t group_;
  std::vector<std::uint32_t> order_;  ///< the discs, group after group
  /// The discs again, group by group: a list of each coordinate of the centres, then of the normals, then of squared radii.
  std::vector<float> groups_;
  EmbreeScene embree_;
};

}  // namespace splatray::testing
