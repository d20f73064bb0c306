/// Embree's oriented discs.
#pragma once
#include "tests/bench/peers/embree_scene.h"
#include "tests/bench/peers/peer.h"
#include "tests/bench/peers/peer_discs.h"

namespace splatray::testing {

/// RTC_GEOMETRY_TYPE_ORIENTED_DISC_POINT, one traversal for `width` rays: 1, 8 or 16. BLEND_NEAREST takes Embree's answer as it is, with
/// back faces rejected by a filter where an object is one-sided (Embree does not cull them). BLEND_WINDOW gathers all
/// hits in a filter that ends the ray at the window's end.
class EmbreeDiscs : public Peer {
 public:
  /// `discs` must outlive the peer.
  EmbreeDiscs(const Discs& discs, const Settings& settings, unsigned width = 8,
              RTCBuildQuality quality = RTC_BUILD_QUALITY_MEDIUM);
  void trace(std::span<const RayQuery> rays, std::span<RayHit> hits) const override;
  void occluded(std::span<const RayQuery> rays, std::span<std::uint8_t> blocked) const override;
  void expect_coherent(bool coherent) override { coherent_ = coherent; }
  [[nodiscard]] std::uint64_t bytes() const override { return embree_.bytes() + discs_.bytes(); }

 private:
  void trace_alone(const RayQuery& ray, RayHit& hit) const;
  template <unsigned WIDTH>
  void trace_together(std::span<const RayQuery> rays, std::span<RayHit> hits) const;
  [[nodiscard]] RTCIntersectContextFlags flags() const {
    return coherent_ ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  }

  const Discs& discs_;
  Settings settings_;
  unsigned width_;
  bool coherent_ = true;
  EmbreeScene embree_;
};

}  // namespace splatray::testing
