#include "tests/bench/peers/peer_frame.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include "engine/base/stopwatch.h"

namespace splatray::testing {
namespace {

/// Pixels of a bundle, neighbours; and bundles of a task.
constexpr std::uint32_t BUNDLE_WIDTH = 4;
constexpr std::uint32_t BUNDLE_HEIGHT = Peer::BUNDLE / BUNDLE_WIDTH;
constexpr std::uint32_t TASK_ROWS = 8;

RayQuery primary_ray(const FrameParams& frame, std::uint32_t column, std::uint32_t row) {
  const float x = static_cast<float>(column) + 0.5F;
  const float y = static_cast<float>(row) + 0.5F;
  RayQuery ray{};
  ray.origin = frame.origin_00 + frame.origin_dx * x + frame.origin_dy * y;
  ray.t_min = frame.t_min;
  ray.dir = glm::normalize(frame.dir_00 + frame.dir_dx * x + frame.dir_dy * y);
  ray.from_object = NO_OBJECT;
  return ray;
}

AovPixel aov_of(const RayHit& hit, const FrameParams& frame) {
  AovPixel pixel{};
  pixel.normal = hit.object == NO_OBJECT ? vec3(0.0F) : hit.normal;
  pixel.z = hit.t * frame.root_unit_world;
  pixel.object = hit.object;
  return pixel;
}

/// The pixels of one bundle, in rows.
void visit_bundle(const FrameParams& frame, std::uint32_t left, std::uint32_t top,
                  const BundleVisitor& visit) {
  std::array<RayQuery, Peer::BUNDLE> rays;
  std::array<std::size_t, Peer::BUNDLE> pixels;
  std::size_t count = 0;
  for (std::uint32_t y = top; y < std::min(top + BUNDLE_HEIGHT, frame.height); ++y)
    for (std::uint32_t x = left; x < std::min(left + BUNDLE_WIDTH, frame.width); ++x) {
      rays[count] = primary_ray(frame, x, y);
      pixels[count++] = std::size_t{y} * frame.width + x;
    }
  visit(std::span(rays).first(count), std::span(pixels).first(count));
}

void visit_all(const FrameParams& frame, const BundleVisitor& visit) {
  const std::uint32_t tasks = (frame.height + TASK_ROWS - 1) / TASK_ROWS;
  tbb::parallel_for(std::uint32_t{0}, tasks, [&](std::uint32_t task) {
    const std::uint32_t end = std::min((task + 1) * TASK_ROWS, frame.height);
    for (std::uint32_t y = task * TASK_ROWS; y < end; y += BUNDLE_HEIGHT)
      for (std::uint32_t x = 0; x < frame.width; x += BUNDLE_WIDTH) visit_bundle(frame, x, y, visit);
  });
}

/// Calls visit(begin, count) for each bundle of a list, on all threads. Returns the wall time in milliseconds.
template <class Visit>
double visit_list(std::size_t size, const Visit& visit) {
  const std::size_t bundles = (size + Peer::BUNDLE - 1) / Peer::BUNDLE;
  const auto start = std::chrono::steady_clock::now();
  tbb::parallel_for(std::size_t{0}, bundles, [&](std::size_t bundle) {
    const std::size_t begin = bundle * Peer::BUNDLE;
    visit(begin, std::min(Peer::BUNDLE, size - begin));
  });
  return milliseconds_since(start);
}

}  // namespace

double visit_bundles(const FrameParams& frame, unsigned threads, const BundleVisitor& visit) {
  assert(frame.t_min >= 0.0F);
  tbb::task_arena arena(static_cast<int>(threads));
  const auto begin = std::chrono::steady_clock::now();
  arena.execute([&] { visit_all(frame, visit); });
  return milliseconds_since(begin);
}

double trace_frame(const Peer& peer, const FrameParams& frame, unsigned threads, Image& image) {
  image.width = frame.width;
  image.height = frame.height;
  image.aov.resize(std::size_t{image.width} * image.height);
  return visit_bundles(frame, threads,
                       [&](std::span<const RayQuery> rays, std::span<const std::size_t> pixels) {
                         std::array<RayHit, Peer::BUNDLE> hits;
                         peer.trace(rays, std::span(hits).first(rays.size()));
                         for (std::size_t i = 0; i < rays.size(); ++i)
                           image.aov[pixels[i]] = aov_of(hits[i], frame);
                       });
}

double trace_rays(const Peer& peer, std::span<const RayQuery> rays, std::span<RayHit> hits) {
  return visit_list(rays.size(), [&](std::size_t begin, std::size_t count) {
    peer.trace(rays.subspan(begin, count), hits.subspan(begin, count));
  });
}

double occlude_rays(const Peer& peer, std::span<const RayQuery> rays, std::span<std::uint8_t> blocked) {
  return visit_list(rays.size(), [&](std::size_t begin, std::size_t count) {
    peer.occluded(rays.subspan(begin, count), blocked.subspan(begin, count));
  });
}

std::vector<RayHit> intersect(const Peer& peer, std::span<const RayQuery> rays) {
  std::vector<RayHit> hits(rays.size());
  trace_rays(peer, rays, hits);
  return hits;
}

}  // namespace splatray::testing
