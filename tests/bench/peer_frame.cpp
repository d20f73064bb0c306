#include "tests/bench/peer_frame.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>

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

void trace_bundle(const Peer& peer, const FrameParams& frame, std::uint32_t left, std::uint32_t top,
                  Image& image) {
  std::array<RayQuery, Peer::BUNDLE> rays;
  std::array<RayHit, Peer::BUNDLE> hits;
  std::array<std::size_t, Peer::BUNDLE> pixels;
  std::size_t count = 0;
  for (std::uint32_t y = top; y < std::min(top + BUNDLE_HEIGHT, image.height); ++y)
    for (std::uint32_t x = left; x < std::min(left + BUNDLE_WIDTH, image.width); ++x) {
      rays[count] = primary_ray(frame, x, y);
      pixels[count++] = std::size_t{y} * image.width + x;
    }
  peer.trace(std::span(rays).first(count), std::span(hits).first(count));
  for (std::size_t i = 0; i < count; ++i) image.aov[pixels[i]] = aov_of(hits[i], frame);
}

void trace_into(const Peer& peer, const FrameParams& frame, Image& image) {
  const std::uint32_t tasks = (image.height + TASK_ROWS - 1) / TASK_ROWS;
  tbb::parallel_for(std::uint32_t{0}, tasks, [&](std::uint32_t task) {
    const std::uint32_t end = std::min((task + 1) * TASK_ROWS, image.height);
    for (std::uint32_t y = task * TASK_ROWS; y < end; y += BUNDLE_HEIGHT)
      for (std::uint32_t x = 0; x < image.width; x += BUNDLE_WIDTH) trace_bundle(peer, frame, x, y, image);
  });
}

}  // namespace

double trace_frame(const Peer& peer, const FrameParams& frame, unsigned threads, Image& image) {
  using Clock = std::chrono::steady_clock;
  assert(frame.t_min >= 0.0F);
  image.width = frame.width;
  image.height = frame.height;
  image.aov.resize(std::size_t{image.width} * image.height);
  tbb::task_arena arena(static_cast<int>(threads));
  const auto begin = Clock::now();
  arena.execute([&] { trace_into(peer, frame, image); });
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

std::vector<RayHit> intersect(const Peer& peer, std::span<const RayQuery> rays) {
  std::vector<RayHit> hits(rays.size());
  const std::size_t bundles = (rays.size() + Peer::BUNDLE - 1) / Peer::BUNDLE;
  tbb::parallel_for(std::size_t{0}, bundles, [&](std::size_t bundle) {
    const std::size_t begin = bundle * Peer::BUNDLE;
    const std::size_t count = std::min(Peer::BUNDLE, rays.size() - begin);
    peer.trace(rays.subspan(begin, count), std::span(hits).subspan(begin, count));
  });
  return hits;
}

}  // namespace splatray::testing
