// Mirrors that meet in a sharp corner: the number of bounces against exact planes, with the side rule, and with
// the minimum distance that fails there (Goradia et al. 2010, Fig. 11).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/hard/support/chains.h"
#include "tests/hard/support/clouds.h"
#include "tests/hard/support/wedges.h"

namespace splatray::testing {
namespace {

using glm::dvec3;

constexpr std::uint64_t WEDGE_SPLATS = 20000;
constexpr int MOST_BOUNCES = 16;

struct WedgeCase {
  double angle_deg;
  bool even;
  /// Wrong rays that are known, up to the corner and beyond r of it.
  std::uint64_t known_all = 0, known_beyond = 0;
};

/// World rays at the inner sides of the wedge, and what happens to them.
struct WedgeRays {
  std::vector<RayQuery> rays;
  std::vector<ExactWedge::Path> paths;
};

WedgeRays rays_at(const ExactWedge& wedge, const Scene& scene, std::size_t first, std::size_t count) {
  std::mt19937_64 random(first + 1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  WedgeRays made;
  for (std::size_t i = 0; i < count; ++i) {
    dvec3 dir = random_unit(random);
    const std::size_t mirror = i % 2;
    if (glm::dot(dir, wedge.normal(mirror)) > 0.0) dir = -dir;
    const dvec3 origin = wedge.point(mirror, unit(random), unit(random)) - 3.0 * dir;
    made.rays.push_back(primary_ray(scene.root.to_root(origin), dir));
    const dvec3 origin_rounded = scene.root.to_world(dvec3(made.rays.back().origin));
    made.paths.push_back(wedge.trace(origin_rounded, glm::normalize(dvec3(made.rays.back().dir))));
  }
  return made;
}

/// How many mirrors each ray meets on the device.
std::vector<std::uint32_t> bounces_on(DeviceScene& device, const std::vector<RayQuery>& rays,
                                      const Settings& settings) {
  std::vector<std::uint32_t> bounces(rays.size(), 0);
  std::vector<std::size_t> index = indices(rays.size());
  Segment segment = traced(device, rays, settings);
  for (int bounce = 0; bounce < MOST_BOUNCES && !segment.rays.empty(); ++bounce) {
    std::vector<RayQuery> next = mirrored_rays(segment, index);
    for (const std::size_t ray : index) ++bounces[ray];
    segment = traced(device, std::move(next), settings);
  }
  return bounces;
}

/// Wrong bounces farther than r from the corner, and all of them.
struct WrongBounces {
  CaseRow beyond;
  CaseRow all;
};

/// Rays with another number of bounces than exact mirrors give. Left out: rays within 4 r of the mirrors' outer
/// borders, and rays that meet a mirror at less than half a degree.
WrongBounces wrong_bounces(const WedgeCase& wedge_case, std::size_t rays, const Settings& settings) {
  const ExactWedge wedge(wedge_case.angle_deg);
  const Scene scene = scene_of({{wedge.sampled(WEDGE_SPLATS, wedge_case.even), mirror_material()}});
  const double radius = median_radius_root(scene) * scene.root.unit_world;
  DeviceScene device(scene);
  WrongBounces wrong;
  in_batches(rays, [&](std::size_t first, std::size_t count) {
    const WedgeRays made = rays_at(wedge, scene, first, count);
    const std::vector<std::uint32_t> bounces = bounces_on(device, made.rays, settings);
    for (std::size_t i = 0; i < count; ++i) {
      const ExactWedge::Path& path = made.paths[i];
      if (path.border_distance < 4.0 * radius || path.least_cosine < 0.01) continue;
      const bool beyond = path.corner_distance > radius;
      const std::uint64_t different = bounces[i] != path.bounces ? 1 : 0;
      wrong.all.count += 1;
      wrong.all.exceptions += different;
      wrong.beyond.count += beyond ? 1 : 0;
      wrong.beyond.exceptions += beyond ? different : 0;
    }
  });
  const CaseRow troubles = device.row("");
  wrong.all.lost = troubles.lost;
  wrong.all.non_finite = troubles.non_finite;
  return wrong;
}

class Wedge : public ::testing::TestWithParam<WedgeCase> {};

TEST_P(Wedge, BouncesAreExact) {
  WrongBounces wrong = wrong_bounces(GetParam(), hard_rays() / 4, {});
  wrong.all.compared = "bounces, exact planes, up to the corner";
  note(wrong.all, GetParam().known_all);
  wrong.beyond.compared = "bounces, exact planes, farther than r from the corner";
  // Random samples end unevenly at the mirrors' borders, and some of their discs stick out farther than 4 r.
  conclude_missed(wrong.beyond, GetParam().known_beyond);
}

TEST_P(Wedge, MinimumDistanceFails) {
  Settings settings;
  settings.side = SIDE_DELTA;
  settings.delta_world = 0.02;
  constexpr std::size_t ENOUGH_TO_FAIL = 10'000;
  WrongBounces wrong = wrong_bounces(GetParam(), std::max(hard_rays() / 20, ENOUGH_TO_FAIL), settings);
  wrong.beyond.compared = "the same with side rule delta = 0.02";
  conclude_failing(wrong.beyond);
}

INSTANTIATE_TEST_SUITE_P(Corner, Wedge,
                         ::testing::Values(WedgeCase{90.0, true},
                                           WedgeCase{90.0, false, known_of(0, 5), known_of(0, 5)},
                                           WedgeCase{30.0, true},
                                           WedgeCase{30.0, false, known_of(100, 847), known_of(1, 12)}),
                         [](const auto& wedge) {
                           return (wedge.param.angle_deg == 90.0 ? std::string("90Degrees") : "30Degrees") +
                                  (wedge.param.even ? "Even" : "Random");
                         });

}  // namespace
}  // namespace splatray::testing
