// The same scene at other scales and places: the same splats in root space, and the same hits.
#include <gtest/gtest.h>

#include <cmath>

#include "data/shapes.h"
#include "tests/hard/support/clouds.h"
#include "tests/hard/support/device_scene.h"
#include "tests/trace/rays.h"

namespace splatray::testing {
namespace {

using glm::dvec3;

/// A sphere of radius 1, its positions multiples of 2^-24, so that large offsets keep them exactly; of radius
/// `scale`, moved.
Scene placed_sphere(double scale, const dvec3& offset) {
  OrientedPoints points = sphere({.count = 5000, .even = false}, 1.0);
  for (dvec3& position : points.position) position = glm::round(position * 0x1p24) * 0x1p-24 * scale + offset;
  return scene_of({{points, test_material(MATERIAL_TWO_SIDED)}});
}

struct Placement {
  const char* name;
  double scale;
  dvec3 offset;
  bool exact = true;        ///< float64 holds points and root transform well below a lattice unit
  std::uint64_t known = 0;  ///< rays whose hits are known to differ, where not exact
};

std::ostream& operator<<(std::ostream& out, const Placement& placement) { return out << placement.name; }

class Placed : public ::testing::TestWithParam<Placement> {};

TEST_P(Placed, HitsAreTheSameInRootSpace) {
  const Scene at_origin = placed_sphere(1.0, dvec3(0.0));
  const Scene placed = placed_sphere(GetParam().scale, GetParam().offset);
  if (GetParam().exact) {
    EXPECT_NEAR(placed.root.unit_world / at_origin.root.unit_world / GetParam().scale, 1.0, 1e-9);
  }
  const std::vector<RayQuery> rays = random_primary_rays(at_origin, 50000, 1);
  DeviceScene device(placed);
  const std::vector<RayHit> hits = device.intersect(rays);
  CaseRow row = device.row("bits of hits, those at scale 1 without offset");
  row.count = rays.size();
  row.exceptions = different_bits(DeviceScene(at_origin).intersect(rays), hits);
  row.remark = std::to_string(different_bits(at_origin.data_pool, placed.data_pool)) + " splats differ";
  GetParam().exact ? conclude(row) : note(row, GetParam().known);
}

/// A picture's camera is given in world space: it must see the same, too.
TEST_P(Placed, PicturesAreTheSame) {
  Settings settings;
  settings.samples = 1;
  settings.aov = true;
  std::vector<Image> images;
  CaseRow row;
  for (const Placement& placement : {Placement{"", 1.0, dvec3(0.0)}, GetParam()}) {
    DeviceScene device(placed_sphere(placement.scale, placement.offset));
    View view{{.eye = placement.offset + placement.scale * dvec3(2.0, 1.0, 3.0), .target = placement.offset},
              hard_width(128),
              hard_width(128)};
    images.push_back(device.render(view, settings, {}));
    row =
        device.row("object of each pixel and its normal within 0.1 degree, those at scale 1 without offset");
  }
  row.unit = "pixels";
  row.count = images[0].aov.size();
  for (std::size_t i = 0; i < images[0].aov.size(); ++i) {
    const AovPixel& a = images[0].aov[i];
    const AovPixel& b = images[1].aov[i];
    row.exceptions += a.object != b.object || glm::length(a.normal - b.normal) > 0.00175F ? 1 : 0;
  }
  conclude(row);
}

INSTANTIATE_TEST_SUITE_P(
    Scale, Placed,
    ::testing::Values(Placement{"Micrometres", 1e-6, dvec3(0.0)}, Placement{"Megametres", 1e6, dvec3(0.0)},
                      Placement{"Utm", 1.0, dvec3(412345.0, 5654321.0, 312.0), false, 0},
                      Placement{"Offset1e7", 1.0, dvec3(1e7, -1e7, 1e6), false, 447},
                      Placement{"MillimetresAt1e6", 0x1p-10, dvec3(1e6, 1e6, 0.0), false, 39238}),
    [](const auto& placement) { return std::string(placement.param.name); });

TEST(Scale, AMovedPointIsNoticed) {
  OrientedPoints points = sphere({.count = 5000, .even = false}, 1.0);
  const Scene scene = scene_of({{points, test_material(MATERIAL_TWO_SIDED)}});
  points.position[2500] *= 0.99;
  const std::vector<RayQuery> rays = random_primary_rays(scene, 50000, 1);
  DeviceScene device(scene_of({{points, test_material(MATERIAL_TWO_SIDED)}}));
  const std::vector<RayHit> hits = device.intersect(rays);
  CaseRow row = device.row("bits of hits, one point moved by 1 %");
  row.count = rays.size();
  row.exceptions = different_bits(DeviceScene(scene).intersect(rays), hits);
  conclude_failing(row);
}

}  // namespace
}  // namespace splatray::testing
