/// The triangles that the points come from.
#pragma once
#include "preprocess/points.h"
#include "tests/bench/peers/embree_scene.h"
#include "tests/bench/peers/peer.h"

namespace splatray::testing {

/// RTC_GEOMETRY_TYPE_TRIANGLE, eight rays at once, with the smooth normals of the truth (mesh_truth.h). Both faces are hit.
class EmbreeMesh : public Peer {
 public:
  /// `mesh` must outlive the peer; `root` is where rays are.
  EmbreeMesh(const Mesh& mesh, const RootTransform& root);
  void trace(std::span<const RayQuery> rays, std::span<RayHit> hits) const override;
  void occluded(std::span<const RayQuery> rays, std::span<std::uint8_t> blocked) const override;
  [[nodiscard]] std::uint64_t bytes() const override;

 private:
  const Mesh& mesh_;
  std::vector<vec3> corner_normals_;
  EmbreeScene embree_;
};

}  // namespace splatray::testing
