// The module of path tracing that GPUs run, beside that of CPU devices: the same bits on one device.
#include "tests/all_tests.h"
#include "tests/light/lit.h"
#include "tests/trace/different_bits.h"

namespace splatray::testing {
namespace {

class Modules : public Lit {
 protected:
  /// A floor, a mirror and a ball of glass.
  static Scene scene() {
    TestObject floor{rectangle_surface("floor", {-2.0, 0.0, 2.0}, {4.0, 0.0, 0.0}, {0.0, 0.0, -4.0})
                         .make({.count = 1000, .even = true}),
                     grey(0.7F)};
    TestObject mirror{rectangle_surface("mirror", {-1.0, 0.0, -0.8}, {2.0, 0.0, 0.0}, {0.0, 1.5, 0.0})
                          .make({.count = 1000, .even = true}),
                      grey(0.5F)};
    mirror.material.phong.mirror = 0.8F;
    return scene_of(
        {floor, mirror, {ball_at({0.2, 0.5, 0.2}, 0.4, 1000), test_material(MATERIAL_DIELECTRIC)}});
  }
  /// A picture by the module of these kernels.
  std::vector<vec4> picture_by(Kernels kernels, const Settings& settings) {
    ShownTracer tracer(device_, {.kernels = kernels});
    tracer.upload(scene());
    tracer.set_environment(studio_environment());
    tracer.look.lights = {{LIGHT_POINT, {1.0, 2.0, 1.0}, vec3(3.0F), 0.1}};
    const Camera camera{dvec3(0.5, 1.2, 3.0), dvec3(0.0, 0.4, 0.0), dvec3(0.0, 1.0, 0.0), 45.0, 0.0};
    return tracer.render({camera, 24, 24}, settings).rgba;
  }
  /// Compares pictures of a look; another seed shows that they would differ.
  void expect_same_bits(std::uint32_t look) {
    Settings settings = lit(3);
    settings.look = look;
    settings.max_bounces = 6;
    const auto by_gpus = picture_by(Kernels::gpu, settings);
    EXPECT_EQ(different_bits(by_gpus, picture_by(Kernels::automatic, settings)), 0U);
    settings.seed = 9;
    EXPECT_GT(different_bits(by_gpus, picture_by(Kernels::automatic, settings)), by_gpus.size() / 4);
  }
};

TEST_F(Modules, OfGpusAndCpuDevicesLightTheSame) {
  if (device_.profile().kernels == Kernels::gpu) GTEST_SKIP() << "the device runs the module of GPUs alone";
  expect_same_bits(LOOK_LIT);
}

/// Slow to compile for little more: with tests/run --all.
TEST_F(Modules, OfGpusAndCpuDevicesAgreeInAllLooks) {
  SPLATRAY_NIGHTLY();
  if (device_.profile().kernels == Kernels::gpu) GTEST_SKIP() << "the device runs the module of GPUs alone";
  for (const std::uint32_t look : {LOOK_CLAY, LOOK_AO, LOOK_SCAN}) expect_same_bits(look);
}

}  // namespace
}  // namespace splatray::testing
