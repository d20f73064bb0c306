// Tracer's ray queries.
#include <algorithm>

#include "engine/gpu/tracer_parts.h"

namespace splatray {
namespace {

constexpr std::uint32_t QUERY_RAYS = 1U << 20U;  ///< in one dispatch

}  // namespace

std::vector<RayHit> Tracer::intersect(const Look& look, std::span<const RayQuery> rays,
                                      const Settings& settings) {
  Impl& impl = *impl_;
  Runner& runner = impl.runner;
  runner.require_scene("intersect()");
  const auto start = std::chrono::steady_clock::now();
  impl.start();
  runner.scene.show(look);
  const std::size_t most = std::min<std::size_t>(rays.size(), QUERY_RAYS);
  runner.queue->reserve(runner.rays, most * sizeof(RayQuery));
  runner.queue->reserve(runner.hits, most * sizeof(RayHit));
  runner.bind(*runner.accumulation);
  runner.scene.expect_rays(rays.size());
  Dispatch dispatch;
  dispatch.program = Program::rays;
  dispatch.constants = query_features(runner.scene.content(), settings);
  dispatch.frame = runner.scene.query_params(settings);
  std::vector<RayHit> hits(rays.size());
  double trace_ms = 0.0;
  for (std::size_t at = 0; at < rays.size(); at += most) {
    const std::size_t count = std::min(most, rays.size() - at);
    runner.queue->upload(*runner.rays, std::as_bytes(rays.subspan(at, count)));
    dispatch.frame.tile_width = dispatch.frame.width = static_cast<std::uint32_t>(count);
    dispatch.groups_x = groups(dispatch.frame.width, GROUP_SIZE);
    trace_ms += runner.run(dispatch);
    runner.queue->download(*runner.hits, std::as_writable_bytes(std::span(hits).subspan(at, count)));
  }
  impl.finish(start);
  impl.stats.trace_ms = trace_ms;
  return hits;
}

}  // namespace splatray
