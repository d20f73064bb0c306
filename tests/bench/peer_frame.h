/// Frames and answers of a peer, as the engine gives them.
#pragma once
#include <vector>

#include "engine/host/image.h"
#include "engine/host/view.h"
#include "tests/bench/peer.h"

namespace splatray::testing {

/// Traces one ray through the centre of each pixel of `frame` on `threads` threads and fills `image.aov` as the engine does
/// (without counters). Returns the wall time in milliseconds. The camera must be a perspective one within four root
/// edges of the scene (FrameParams::t_min >= 0).
double trace_frame(const Peer& peer, const FrameParams& frame, unsigned threads, Image& image);

/// Hits of arbitrary rays, on all threads.
[[nodiscard]] std::vector<RayHit> intersect(const Peer& peer, std::span<const RayQuery> rays);

}  // namespace splatray::testing
