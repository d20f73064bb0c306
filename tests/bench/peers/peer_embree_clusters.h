/// Groups of discs as Embree's user geometry.
#pragma once
#include "tests/bench/peers/embree_scene.h"
#include "tests/bench/peers/peer.h"
#include "tests/bench/peers/peer_discs.h"

namespace splatray::testing {

/// RTC_GEOMETRY_TYPE_USER: each primitive is `group` discs that lie together, in their tightest box: halves of the
/// discs along the longest side, again and again, each but the last a multiple of `group`. All are tested in one vectorised loop
/// for a ray, one traversal for `width` rays: 1, 8 or 16. A group of 1 is a disc of its own. Hits are gathered as the discs are
/// tested, without a filter.
class EmbreeClusters : public Peer {
 public:
  /// Most discs of a group.
  static constexpr std::size_t GROUP_MOST = 64;

  /// `discs` must outlive the peer; `group` in 1..GROUP_MOST.
  EmbreeClusters(const Discs& discs, const Settings& settings, std::size_t group, unsigned width = 1,
                 RTCBuildQuality quality = RTC_BUILD_QUALITY_MEDIUM);
  void trace(std::span<const RayQuery> rays, std::span<RayHit> hits) const override;
  void occluded(std::span<const RayQuery> rays, std::span<std::uint8_t> blocked) const override;
  void expect_coherent(bool coherent) override { coherent_ = coherent; }
  [[nodiscard]] std::uint64_t bytes() const override;

 private:
  template <unsigned WIDTH>
  void trace_together(std::span<const RayQuery> rays, std::span<RayHit> hits) const;
  [[nodiscard]] RTCIntersectContextFlags flags() const {
    return coherent_ ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  }
  static void bounds_of(const RTCBoundsFunctionArguments* args);
  static void intersect(const RTCIntersectFunctionNArguments* args);
  static void occlude(const RTCOccludedFunctionNArguments* args);
  /// Calls visit(disc, t) for each disc of a primitive that the ray meets.
  template <class Visit>
  void visit_meetings(unsigned primitive, const RTCRay& ray, const Visit& visit) const;

  const Discs& discs_;
  Settings settings_;
  std::size_t group_;
  unsigned width_;
  bool coherent_ = true;
  std::vector<std::uint32_t> order_;  ///< the discs, group after group
  /// The discs again, group by group: a list of each coordinate of the centres, then of the normals, then of squared radii.
  std::vector<float> groups_;
  EmbreeScene embree_;
};

}  // namespace splatray::testing
