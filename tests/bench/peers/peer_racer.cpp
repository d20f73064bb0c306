#include "tests/bench/peers/peer_racer.h"

#include <embree3/rtcore.h>

#include <thread>
#include <utility>

#include "tests/bench/measure/processor.h"
#include "tests/bench/peers/peer_frame.h"

namespace splatray::testing {

PeerRacer::PeerRacer(std::unique_ptr<Peer> peer, std::string method, const Settings& settings,
                     std::size_t group, double build_s, const Course& course)
    : peer_(std::move(peer)),
      method_(std::move(method)),
      settings_(settings),
      group_(group),
      build_s_(build_s),
      course_(course),
      hits_(course.probes.rays().size()) {}

PathRays PeerRacer::path_rays(Frame frame) const {
  PathRays rays;
  if (frame == Frame::shadow) rays.to_light = vec3(course_.light.position);
  if (frame == Frame::mirror) rays.bounces = MIRRORED;
  rays.lift = static_cast<float>(LIFT_RADII * course_.radius_world / course_.root.unit_world);
  return rays;
}

double PeerRacer::run(Frame frame) {
  peer_->expect_coherent(frame != Frame::random);
  if (frame == Frame::random) return trace_rays(*peer_, course_.probes.rays(), hits_);
  const bool outside = frame == Frame::primary || frame == Frame::shadow;
  return trace_paths(*peer_, outside ? course_.outside_frame : course_.inside_frame, processor_threads(),
                     path_rays(frame), counts_);
}

std::uint64_t PeerRacer::count_rays(Frame frame) {
  run(frame);
  if (frame == Frame::random) return hits_.size();
  std::uint64_t rays = 0;
  for (const PathCount& count : counts_) rays += count.secondary;
  return rays;
}

Image PeerRacer::picture() {
  peer_->expect_coherent(true);
  trace_frame(*peer_, course_.outside_frame, processor_threads(), image_);
  return image_;
}

std::vector<RayHit> PeerRacer::intersect(std::span<const RayQuery> rays) {
  peer_->expect_coherent(false);
  std::vector<RayQuery> lifted(rays.begin(), rays.end());
  for (RayQuery& ray : lifted) ray.origin += path_rays(Frame::mirror).lift * ray.from_normal;
  return testing::intersect(*peer_, lifted);
}

std::uint64_t PeerRacer::false_shadows() {
  run(Frame::shadow);
  std::uint64_t blocked = 0;
  for (const PathCount& count : counts_) blocked += count.blocked;
  return blocked;
}

void PeerRacer::describe(Json& record) {
  record["method"] = method_;
  record["settings"]["blend"] = blend_word(settings_.blend);
  record["settings"]["threads"] = processor_threads();
  if (group_ > 0) record["settings"]["leaf_size"] = group_;
  record["device"] = {{"name", processor_name()}, {"driver", "Embree " RTC_VERSION_STRING}};
  record["speed"]["build_s"] = build_s_;
  record["speed"]["bytes_per_splat"] =
      static_cast<double>(peer_->bytes()) / static_cast<double>(course_.splats);
}

}  // namespace splatray::testing
