/// Other ray tracers of the same splats, or of the mesh they come from: what splatray's speed and error are held against.
#pragma once
#include <cstdint>
#include <span>
#include <string>

#include "shaders/layout.h"

namespace splatray::testing {

class Peer {
 public:
  virtual ~Peer() = default;

  /// Most rays that trace() answers at once: neighbours, so that they may share a traversal.
  static constexpr std::size_t BUNDLE = 16;
  /// Answers up to BUNDLE primary rays of root space: `normal`, `t` (+inf on a miss), `object` and `members` of the hits
  /// are set. May be called by several threads at once. `inside`, `from_normal` and `from_object` are not read.
  virtual void trace(std::span<const RayQuery> rays, std::span<RayHit> hits) const = 0;
  /// Whether anything lies on each of up to BUNDLE such rays: 1 or 0. Any hit will do, so that the first found ends a ray.
  virtual void occluded(std::span<const RayQuery> rays, std::span<std::uint8_t> blocked) const = 0;
  /// Says whether the next rays of a bundle go about the same way, as they do at first.
  virtual void expect_coherent(bool /*coherent*/) {}

  /// Memory of the data structure and of what it refers to.
  [[nodiscard]] virtual std::uint64_t bytes() const = 0;
};

}  // namespace splatray::testing
