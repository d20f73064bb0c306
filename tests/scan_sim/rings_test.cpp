// What preprocess makes of the rings of spinning scanners: ellipses that join them.
#include <gtest/gtest.h>

#include "engine/scene/clip.h"
#include "engine/scene/splat.h"
#include "preprocess/scan/sides.h"
#include "tests/all_tests.h"
#include "tests/scan_sim/built_scan.h"
#include "tests/scan_sim/ring_errors.h"
#include "tests/scan_sim/scan_cases.h"
#include "tests/scan_sim/sim_meshes.h"

namespace splatray::testing {
namespace {

double ellipse_share(const BuiltScan& built) {
  return static_cast<double>(built.stats.ellipses) / static_cast<double>(built.stats.splats);
}

class RingSweep : public ::testing::TestWithParam<int> {};

TEST_P(RingSweep, AreBuiltScanByEllipses) {
  if (GetParam() != 32) SPLATRAY_NIGHTLY();
  const Sweep sweep = street_sweep(GetParam());
  const RingErrors joined =
      ring_errors(build_scan(sweep.scan.points).scene, *sweep.mesh, sweep.spinner, 10000);
  EXPECT_LT(joined.stripes_percent, 1.0);
  EXPECT_LT(joined.overlap, 3.0);
}

INSTANTIATE_TEST_SUITE_P(Rings, RingSweep, ::testing::Values(16, 32, 64, 128));

TEST(Rings, OfDiscsHaveStripesOrOverlap) {
  SPLATRAY_NIGHTLY();
  const Sweep sweep = street_sweep(32);
  const RingErrors discs =
      ring_errors(build_scan(sweep.scan.points, {.clip = false}).scene, *sweep.mesh, sweep.spinner, 10000);
  EXPECT_TRUE(discs.stripes_percent > 2.0 || discs.overlap > 6.0)
      << discs.stripes_percent << ' ' << discs.overlap << ": the comparison above can fail";
}

TEST(Rings, ShowTheScannersPlace) {
  const Sweep sweep = without_stations(street_sweep(32));
  const BuiltScan built = build_scan(sweep.scan.points);
  EXPECT_EQ(built.stats.sides_by[static_cast<std::size_t>(SideRung::sensor)], 1U);
}

/// From ever farther away straight rows look ever more alike: no scanner is there.
TEST(Rings, RowsOfAGridShowNoPlaceAndEnd) {
  for (const double apart : {0.5, 1.0, 2.0, 4.0}) {
    SimulatedScan rows;
    for (int n = 0; n < 1500; ++n) rows.points.position.emplace_back(0.2 * (n % 100), apart * (n / 100), 0.0);
    const BuiltScan built = build_scan(rows.points);
    EXPECT_EQ(built.stats.sides_by[static_cast<std::size_t>(SideRung::sensor)], 0U) << apart;
  }
}

TEST(Rings, EvenScansHaveNoEllipses) {
  const Tripod tripod{
      .sensors = {{-0.3, 0.2, 1.6}}, .step_deg = 1.0, .lowest_deg = -40.0, .highest_deg = 40.0};
  const BuiltScan room = build_scan(scan_from_tripods(TriangleTree(room_mesh()), tripod, {}).points);
  EXPECT_LT(ellipse_share(room), 0.2);
  const BuiltScan ball =
      build_scan(range_images(TriangleTree(sphere_mesh(5)), {.views = 6, .pixels = 60, .misplaced = 0.0},
                              {.noise = 0.0005})
                     .points);
  EXPECT_EQ(ball.stats.ellipses, 0U);
}

}  // namespace
}  // namespace splatray::testing
