/// A peer in a race, on all threads of the processor.
#pragma once
#include <memory>

#include "tests/bench/measure/racer.h"
#include "tests/bench/peers/peer.h"
#include "tests/bench/peers/peer_paths.h"

namespace splatray::testing {

/// Times are wall times of tracing alone. Shadow and mirrored rays start LIFT_RADII off the surface.
class PeerRacer : public Racer {
 public:
  /// Median radii.
  static constexpr double LIFT_RADII = 0.1;

  /// `build_s`: seconds it took to make the peer. `group`: discs of a primitive, 0 = not grouped. The course must outlive
  /// the racer.
  PeerRacer(std::unique_ptr<Peer> peer, std::string method, const Settings& settings, std::size_t group,
            double build_s, const Course& course);

  double run(Frame frame) override;
  [[nodiscard]] std::uint64_t count_rays(Frame frame) override;
  [[nodiscard]] Image picture() override;
  [[nodiscard]] std::vector<RayHit> intersect(std::span<const RayQuery> rays) override;
  [[nodiscard]] std::uint64_t false_shadows() override;
  void describe(Json& record) override;

 private:
  [[nodiscard]] PathRays path_rays(Frame frame) const;

  std::unique_ptr<Peer> peer_;
  std::string method_;
  Settings settings_;
  std::size_t group_;
  double build_s_;
  const Course& course_;
  Image image_;
  std::vector<PathCount> counts_;
  std::vector<RayHit> hits_;
};

}  // namespace splatray::testing
