// Distances measured on simulated scans hold the true ones in their intervals, as often as they say and not much wider than need be.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <random>

#include "app/library/measure/surface_point.h"
#include "tests/all_tests.h"
#include "tests/scan_sim/built_scan.h"
#include "tests/scan_sim/scan_cases.h"
#include "tests/scan_sim/sim_meshes.h"
#include "tests/trace/brute_force_tree.h"

namespace splatray::testing {
namespace {

/// How measured distances lie to the true ones.
struct Outcome {
  std::size_t measured = 0, inside = 0;
  std::size_t inside_tenth = 0;  ///< of an interval a tenth as wide
  double within = 0.0;           ///< mean half width of the intervals
  double squares = 0.0;          ///< sum of the squares of the errors

  [[nodiscard]] double share(std::size_t part) const {
    return static_cast<double>(part) / static_cast<double>(measured);
  }
  [[nodiscard]] double deviation() const { return std::sqrt(squares / static_cast<double>(measured)); }
};

/// Distances between where pairs of rays from inside meet the surface.
class Measured {
 public:
  Measured(const Scene& scene, const TriangleTree& truth) : scene_(scene), truth_(truth), brute_(scene) {}

  Outcome distances(const glm::dvec3& eye, std::size_t count) {
    std::mt19937_64 random(17);
    std::normal_distribution<double> normal;
    Outcome outcome;
    while (outcome.measured < count) {
      Measure measure{MeasureKind::distance, {}};
      std::vector<glm::dvec3> true_places;
      for (int end = 0; end < 2; ++end) {
        const glm::dvec3 dir = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
        const auto wanted = truth_.first_hit(eye, dir);
        if (!wanted) break;
        RayQuery ray{};
        ray.origin = vec3(scene_.root.to_root(eye));
        ray.dir = vec3(dir);
        ray.from_object = NO_OBJECT;
        const TrueHit hit = brute_.nearest(ray, Settings{});
        const double t = hit.t * scene_.root.unit_world;
        // Of the same surface: not past an edge, behind which is another one.
        if (!hit.found || std::abs(t - wanted->distance) > 0.05) break;
        true_places.push_back(eye + wanted->distance * dir);
        measure.points.push_back(point_on_ray(scene_, {eye + t * dir, hit.normal}, dir));
      }
      if (measure.points.size() < 2) continue;
      const MeasureValue value = values_of(measure, scene_.up).front();
      const double off = value.value - glm::distance(true_places[0], true_places[1]);
      ++outcome.measured;
      outcome.inside += std::abs(off) <= value.within ? 1 : 0;
      outcome.inside_tenth += std::abs(off) <= 0.1 * value.within ? 1 : 0;
      outcome.within += value.within / static_cast<double>(count);
      outcome.squares += off * off;
    }
    return outcome;
  }

 private:
  const Scene& scene_;
  const TriangleTree& truth_;
  BruteForceTree brute_;
};

/// A scan, what it is of, and where its rays come from.
struct MeasuredScan {
  std::string name;
  SimulatedScan scan;
  TriangleTree truth;
  glm::dvec3 eye;
};

std::vector<MeasuredScan> measured_scans() {
  std::vector<MeasuredScan> scans;
  const TriangleTree room(room_mesh());
  const glm::dvec3 eye(-0.3, 0.2, 1.6);
  for (const double noise : all_or(std::vector{0.001, 0.003, 0.01}, std::vector{0.003}))
    scans.push_back({"room, tripod, noise " + std::to_string(noise),
                     scan_from_tripods(room, {.sensors = {eye}}, {.noise = noise}), room, eye});
  return scans;
}

TEST(Measures, HoldTheTruthInTheirIntervals) {
  constexpr std::size_t DISTANCES = 80;
  for (const MeasuredScan& scan : measured_scans()) {
    const BuiltScan built = build_scan(scan.scan.points);
    Measured measured(built.scene, scan.truth);
    const Outcome outcome = measured.distances(scan.eye, DISTANCES);
    std::cout << scan.name << ": " << 100.0 * outcome.share(outcome.inside) << " % inside, intervals of +-"
              << 1000.0 * outcome.within << " mm, errors' deviation " << 1000.0 * outcome.deviation()
              << " mm\n";
    EXPECT_GE(outcome.share(outcome.inside), 0.9) << scan.name;
    EXPECT_LE(outcome.within, 5.0 * outcome.deviation()) << scan.name;
    EXPECT_LT(outcome.share(outcome.inside_tenth), 0.9) << scan.name << ": narrow ones hold it too";
  }
}

TEST(Measures, AnAngleIsNoMoreUnknownThanAllAngles) {
  const SurfacePoint here{{0.0, 0.0, 0.0}, {0.0, 0.0, 0.01}}, there{{1.0, 0.0, 0.0}, {0.0, 0.0, 0.01}};
  EXPECT_EQ(values_of({MeasureKind::angle, {here, here, there}}, {0.0, 0.0, 1.0})[0].within, 180.0);
}

}  // namespace
}  // namespace splatray::testing
