// Light of lights through panes, dielectrics that do not bend it: as much as paths carry through them, straight.
#include "tests/light/lit.h"

namespace splatray::testing {
namespace {

constexpr float TINT = 0.4F;
/// So dark that what it sends back to the pane and gets from it again does not count.
constexpr float ALBEDO = 0.01F;

double mirrored(double cosine) { return 0.04 + 0.96 * std::pow(1.0 - cosine, 5.0); }

/// What a pane with two clear coats and a tint passes.
double passed(double cosine) { return TINT * std::pow(1.0 - mirrored(cosine), 2.0); }

class Panes : public Plane {
 protected:
  /// A level sheet at this height whose front is above or below.
  static void add_sheet(OrientedPoints& points, double y, bool front_above) {
    const double x = front_above ? 3.0 : -3.0;
    append(points, rectangle_surface("sheet", {-x, y, 3.0}, {2.0 * x, 0.0, 0.0}, {0.0, 0.0, -6.0})
                       .make({.count = 4000, .even = true}));
  }
  /// A dark floor below panes, each 4 mm thick, with their lower sides at these heights.
  static Scene floor_below(const std::vector<double>& heights) {
    OrientedPoints panes;
    for (const double height : heights) {
      add_sheet(panes, height, false);
      add_sheet(panes, height + 0.004, true);
    }
    Scene scene = scene_of({floor(), {panes, test_material(MATERIAL_DIELECTRIC)}});
    scene.materials.front() = dark(scene.materials.front());
    scene.materials.back() = pane(scene.materials.back());
    return scene;
  }
  static Material dark(Material material) {
    material.base = vec3(ALBEDO);
    return material;
  }
  static Material pane(Material material) {
    material.ior = 1.0F;
    material.base = vec3(TINT);
    material.metallic = material.roughness = material.coat_roughness = 0.0F;
    material.transmission = material.coat = 1.0F;
    return material;
  }
  /// The floor's irradiance at its middle, seen from below the panes.
  static Mean irradiance_below(ShownTracer& tracer, const Scene& scene, const std::vector<SceneLight>& lights,
                               std::uint32_t samples, const Environment& environment = constant(0.0F)) {
    tracer.upload(scene);
    tracer.set_environment(environment);
    tracer.look.lights = lights;
    const Camera below{dvec3(0.0, 0.9, 0.0), dvec3(0.0), dvec3(0.0, 0.0, -1.0), 30.0, 0.001};
    const Mean radiance = mean_of(tracer.render({below, 4, 4}, lit(samples)));
    return {pi * radiance.value / ALBEDO, pi * radiance.error / ALBEDO};
  }
};

TEST_F(Panes, PassLightWithoutSizeByItsAngle) {
  const Scene scene = floor_below({1.0});
  for (const double angle : {0.0, 0.6, 1.1}) {
    const SceneLight sun{LIGHT_DIRECTIONAL, {std::sin(angle), std::cos(angle), 0.0}, vec3(2.0F)};
    const double expected = 2.0 * std::cos(angle) * passed(std::cos(angle));
    EXPECT_NEAR(irradiance_below(tracer_, scene, {sun}, 16).value, expected, 3e-3 * expected)
        << "angle " << angle;
  }
}

/// As near as their windows of depth allow.
TEST_F(Panes, OfSeveralPassWhatEachPasses) {
  const Scene scene = floor_below({1.0, 1.18, 1.36});
  const double cosine = std::cos(0.5), expected = 2.0 * cosine * std::pow(passed(cosine), 3.0);
  const SceneLight sun{LIGHT_DIRECTIONAL, {std::sin(0.5), cosine, 0.0}, vec3(2.0F)};
  EXPECT_NEAR(irradiance_below(tracer_, scene, {sun}, 16).value, expected, 3e-3 * expected);
}

/// Neither counted twice nor lost, whether paths could find it too or not.
TEST_F(Panes, PassLightWithASize) {
  const Scene scene = floor_below({1.0});
  SceneLight lamp{LIGHT_RECTANGLE, {0.5, 2.0, 0.25}, vec3(5.0F)};
  lamp.edge_u = {0.5, 0.0, 0.0};
  lamp.edge_v = {0.0, 0.0, 0.25};  // cross(u, v) = -y
  double expected = 0.0;
  constexpr int STEPS = 200;
  for (int i = 0; i < STEPS; ++i)
    for (int j = 0; j < STEPS; ++j) {
      const dvec3 at = lamp.position + lamp.edge_u * (2.0 * (i + 0.5) / STEPS - 1.0) +
                       lamp.edge_v * (2.0 * (j + 0.5) / STEPS - 1.0);
      const double cosine = at.y / glm::length(at);
      expected += 5.0 * 0.5 / (STEPS * STEPS) * cosine * cosine / glm::dot(at, at) * passed(cosine);
    }
  const Mean found = irradiance_below(tracer_, scene, {lamp}, 1024);
  EXPECT_NEAR(found.value, expected, 3e-3 * expected + 3.0 * found.error);
  EXPECT_LT(found.error, 0.01 * expected);
}

/// By light samples alone (a picture as environment) as by paths alone (a constant one).
TEST_F(Panes, PassDaylight) {
  const Scene scene = floor_below({1.0});
  const Environment picture{64, 32, std::vector<glm::vec3>(64 * 32, vec3(1.0F)), vec3(0.0F)};
  const Mean by_paths = irradiance_below(tracer_, scene, {}, 1024, constant(1.0F));
  const Mean by_samples = irradiance_below(tracer_, scene, {}, 1024, picture);
  EXPECT_NEAR(by_samples.value, by_paths.value, 3.0 * std::hypot(by_samples.error, by_paths.error));
  EXPECT_LT(by_samples.error, 0.02 * by_samples.value);
}

TEST_F(Panes, DaylightThroughThemIsFoundByLookingForIt) {
  const Scene scene = floor_below({1.0});
  Environment spot{64, 32, std::vector<glm::vec3>(64 * 32, vec3(0.0F)), vec3(0.0F)};
  spot.texels[10 * 64 + 20] = vec3(300.0F);
  const Mean found = irradiance_below(tracer_, scene, {}, 1024, spot);
  EXPECT_GT(found.value, 0.0);
  EXPECT_LT(found.error, 0.02 * found.value) << "paths hit it once in a thousand times";
}

TEST_F(Panes, AreNoWayPastWhatIsOpaque) {
  Scene scene = floor_below({1.0});
  scene.materials.back().transmission = 0.0F;
  scene.materials.back().coat = 0.0F;
  const SceneLight sun{LIGHT_DIRECTIONAL, {0.0, 1.0, 0.0}, vec3(2.0F)};
  EXPECT_NEAR(irradiance_below(tracer_, scene, {sun}, 16).value, 0.0, 1e-3);
}

}  // namespace
}  // namespace splatray::testing
