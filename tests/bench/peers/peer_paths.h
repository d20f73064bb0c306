/// Secondary rays of a peer, as splatray's paths send them.
#pragma once
#include <optional>
#include <vector>

#include "tests/bench/peers/peer_frame.h"

namespace splatray::testing {

/// What follows a primary ray that hits.
struct PathRays {
  std::optional<vec3> to_light;  ///< unit; a shadow ray that way from each first hit that faces it
  std::uint32_t bounces = 0;     ///< mirrored rays, at most
  float lift = 0.0F;  ///< secondary rays start this far off the surface along its normal, root units
};

/// What a pixel's path took.
struct PathCount {
  std::uint8_t secondary = 0;  ///< rays
  std::uint8_t blocked = 0;    ///< of these shadow rays that something lies on
};

/// Traces the primary rays of visit_bundles and what follows them, bundle by bundle; the rays of a bundle stay together
/// as long as they hit. `counts`: one for each pixel, top row first. Returns the wall time in milliseconds.
double trace_paths(const Peer& peer, const FrameParams& frame, unsigned threads, const PathRays& what,
                   std::vector<PathCount>& counts);

}  // namespace splatray::testing
