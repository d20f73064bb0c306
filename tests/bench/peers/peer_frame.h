/// Frames and answers of a peer, as the engine gives them.
#pragma once
#include <functional>
#include <vector>

#include "engine/image/image.h"
#include "engine/image/view.h"
#include "tests/bench/peers/peer.h"

namespace splatray::testing {

/// Gets up to Peer::BUNDLE neighbouring primary rays and the numbers of their pixels, top row first.
using BundleVisitor = std::function<void(std::span<const RayQuery>, std::span<const std::size_t>)>;

/// Calls `visit` for all bundles of a frame, one ray through the centre of each pixel, on `threads` threads. Returns the
/// wall time in milliseconds. The camera must be a perspective one within four root edges of the scene
/// (FrameParams::t_min >= 0).
double visit_bundles(const FrameParams& frame, unsigned threads, const BundleVisitor& visit);

/// Traces the primary rays of visit_bundles and fills `image.aov` as the engine does (without counters). Returns the wall
/// time in milliseconds.
double trace_frame(const Peer& peer, const FrameParams& frame, unsigned threads, Image& image);

/// Hits of arbitrary rays, on all threads, into as many `hits`. Returns the wall time in milliseconds.
double trace_rays(const Peer& peer, std::span<const RayQuery> rays, std::span<RayHit> hits);
/// Whether anything lies on arbitrary rays, on all threads: 1 or 0, as many. Returns the wall time in milliseconds.
double occlude_rays(const Peer& peer, std::span<const RayQuery> rays, std::span<std::uint8_t> blocked);
/// As trace_rays, without the time.
[[nodiscard]] std::vector<RayHit> intersect(const Peer& peer, std::span<const RayQuery> rays);

}  // namespace splatray::testing
