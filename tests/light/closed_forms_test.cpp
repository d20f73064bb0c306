// Light whose amount is known in closed form, as pictures have it.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/all_tests.h"
#include "tests/light/lit.h"

namespace splatray::testing {
namespace {

Scene ball(float albedo, std::size_t splats) {
  return scene_of({{sphere({.count = splats, .even = true, .seed = 3}, 1.0), grey(albedo)}});
}

/// Seen from within: the middle, towards -z.
const Camera FROM_WITHIN{dvec3(0.0), dvec3(0.0, 0.0, -1.0), dvec3(0.0, 1.0, 0.0), 80.0, 0.0};

TEST_F(Lit, WhiteBallUnderWhiteSkyIsWhite) {
  const Scene scene = ball(1.0F, 5000);
  show(scene, constant(1.0F), {});
  Settings settings = lit(16);
  settings.max_bounces = 16;
  const Image image = picture(default_camera(scene, 1.0), settings, 64);
  double lost = 0.0;
  for (const vec4& pixel : image.rgba) {
    EXPECT_LE(pixel.x, 1.00001F);
    lost += 1.0 - double(pixel.x);
  }
  // Directions just above the blended normal's plane can lead below a neighbour's disc, into the ball.
  EXPECT_LE(lost / double(image.rgba.size()), 1e-3);
  EXPECT_EQ(tracer_.stats().counters[COUNT_BELOW], 0U);
  RecordProperty("lost", std::to_string(lost / double(image.rgba.size())));
}

TEST_F(LitOnHost, WhiteBallUnderAWhitePictureIsWhiteOnTheMean) {
  SPLATRAY_NIGHTLY();
  const Scene scene = ball(1.0F, 5000);
  show(scene, {64, 32, std::vector<glm::vec3>(64 * 32, vec3(1.0F)), vec3(0.0F)}, {});
  const Mean mean = mean_of(picture(default_camera(scene, 1.0), lit(32), 48));
  EXPECT_NEAR(mean.value, 1.0, 4.0 * mean.error);
  EXPECT_LT(mean.error, 2e-3);
}

/// Light through the middle of a dielectric that does not bend it, before a white sky.
class Pane : public Lit {
 protected:
  double light_through(const Scene& scene) {
    show(scene, constant(1.0F), {});
    const Camera before{dvec3(0.0, 0.0, 3.0), dvec3(0.0), dvec3(0.0, 1.0, 0.0), 30.0, 0.1};
    return mean_of(picture(before, lit(4), 4)).value;
  }
  /// Two sheets, a thousandth of their width apart.
  static Scene pane(const Material& material) {
    OrientedPoints points;
    for (const double z : {-0.0005, 0.0005}) {
      const double x = z < 0.0 ? -1.0 : 1.0;
      append(points, rectangle_surface("side", {-0.5 * x, -0.5, z}, {x, 0.0, 0.0}, {0.0, 1.0, 0.0})
                         .make({.count = 2000, .even = true}));
    }
    return scene_of({{points, material}});
  }
  static Material clear(float tint) {
    Material material = test_material(MATERIAL_DIELECTRIC);
    material.ior = 1.0F;
    material.phong.tint = vec3(tint);
    return material;
  }
};

TEST_F(Pane, TintsLightOnce) {
  for (const bool thin : {true, false}) {
    Scene scene = thin ? pane(clear(1.0F))
                       : scene_of({{sphere({.count = 5000, .even = true, .seed = 3}, 1.0), clear(1.0F)}});
    scene.materials.front().base = vec3(0.4F);
    EXPECT_NEAR(light_through(scene), 0.4, 1e-6) << (thin ? "a pane" : "a ball");
  }
  EXPECT_NEAR(light_through(pane(clear(0.7F))), 0.49, 1e-6) << "the paper's tint is of each side";
}

TEST_F(Plane, StraightShadowsAreTintedOnce) {
  OrientedPoints pane;
  for (const double y : {1.999, 2.0}) {
    const double x = y < 2.0 ? 1.0 : -1.0;
    append(pane, rectangle_surface("side", {-x, y, -1.0}, {2.0 * x, 0.0, 0.0}, {0.0, 0.0, 2.0})
                     .make({.count = 2000, .even = true}));
  }
  Material clear = test_material(MATERIAL_DIELECTRIC);
  clear.ior = 1.0F;
  clear.phong.tint = vec3(1.0F);
  Scene scene = scene_of({floor(), {pane, clear}});
  scene.materials.back().base = vec3(0.4F);
  show(scene, constant(0.0F), {{LIGHT_DIRECTIONAL, {0.0, 1.0, 0.0}, vec3(2.0F)}});
  const Camera below{dvec3(0.0, 1.5, 0.0), dvec3(0.0), dvec3(0.0, 0.0, -1.0), 30.0, 0.001};
  Settings settings = lit(4);
  settings.straight_shadows = true;
  EXPECT_NEAR(pi * mean_of(picture(below, settings, 4)).value, 0.4 * 2.0, 1e-4);
}

TEST_F(Plane, SpotsShineInTheirCone) {
  SceneLight spot{LIGHT_POINT, {0.0, 2.0, 0.0}, vec3(3.0F)};
  const auto below = [&] {
    show(scene_of({floor()}), constant(0.0F), {spot});
    const Camera narrow{dvec3(0.0, 1.5, 0.0), dvec3(0.0), dvec3(0.0, 0.0, -1.0), 0.5, 0.001};
    return mean_of(picture(narrow, lit(4), 4)).value;
  };
  const double plain = below();
  spot.spot_axis = {0.0, -5.0, 0.0};
  spot.spot_inner = 0.3;
  spot.spot_outer = 0.6;
  EXPECT_NEAR(below(), plain, 1e-5 * plain) << "ahead of it";
  spot.range = 4.0;
  EXPECT_NEAR(below(), plain * (1.0 - std::pow(0.5, 4.0)), 1e-3 * plain);
  spot.range = 0.0;
  spot.spot_axis = {std::sin(0.45), -std::cos(0.45), 0.0};
  const double fall = (std::cos(0.45) - std::cos(0.6)) / (std::cos(0.3) - std::cos(0.6));
  EXPECT_NEAR(below(), plain * fall * fall, 1e-2 * plain) << "at its rim";
  spot.spot_axis = {1.0, 0.0, 0.0};
  EXPECT_EQ(below(), 0.0) << "beside it";
}

/// All bounces at once: the light that a wall gets from the rest of a ball does not depend on where it is.
TEST_F(LitOnHost, IntegratingSphere) {
  SPLATRAY_NIGHTLY();
  constexpr double INTENSITY = 2.0;
  // A direction just above the blended normal's plane can lead below a neighbour's disc and out of the ball: of each bounce's light.
  constexpr double LOST = 1e-4;
  const dvec3 lamp(0.3, 0.2, 0.25);
  for (const double albedo : {0.2, 0.5, 0.9, 0.99}) {
    show(ball(float(albedo), 5000), constant(0.0F), {{LIGHT_POINT, lamp, vec3(float(INTENSITY))}});
    const std::uint32_t edge = 32;
    const Image image = picture(FROM_WITHIN, lit(albedo < 0.8 ? 64 : 192), edge);
    // Each pixel's own direct light, over what its rays see of the wall.
    Mean mean;
    double sum = 0.0, squares = 0.0;
    const double half = std::tan(40.0 * pi / 180.0);
    for (std::uint32_t y = 0; y < edge; ++y)
      for (std::uint32_t x = 0; x < edge; ++x) {
        double direct = 0.0;
        for (int sub = 0; sub < 16; ++sub) {
          const double u = (x + (sub % 4 + 0.5) / 4.0) / edge, v = (y + (sub / 4 + 0.5) / 4.0) / edge;
          const dvec3 wall = glm::normalize(dvec3(half * (2.0 * u - 1.0), half * (1.0 - 2.0 * v), -1.0));
          const dvec3 to_lamp = lamp - wall;
          const double distance = glm::length(to_lamp);
          direct += INTENSITY * glm::dot(-wall, to_lamp) / (distance * distance * distance) / 16.0;
        }
        const double indirect = albedo / (1.0 - albedo) * INTENSITY;
        const double off = double(image.rgba[y * edge + x].x) / (albedo / pi * (direct + indirect)) - 1.0;
        sum += off;
        squares += off * off;
      }
    mean.value = sum / (edge * edge);
    mean.error = std::sqrt((squares / (edge * edge) - mean.value * mean.value) / (edge * edge));
    EXPECT_NEAR(mean.value, 0.0, 3.0 * mean.error + LOST * albedo / (1.0 - albedo)) << "albedo " << albedo;
    EXPECT_LT(mean.error, 2e-3) << "albedo " << albedo;
    EXPECT_EQ(tracer_.stats().counters[COUNT_BOUNCE_LIMIT], 0U);
    RecordProperty("albedo_" + std::to_string(int(100.0 * albedo)),
                   std::to_string(mean.value) + " +- " + std::to_string(mean.error));
  }
}

TEST_F(Plane, LightWithoutSize) {
  EXPECT_NEAR(irradiance({{LIGHT_POINT, {0.0, 2.0, 0.0}, vec3(8.0F)}}, 1).value, 2.0, 1e-3);
  EXPECT_NEAR(irradiance({{LIGHT_DIRECTIONAL, {1.0, 1.0, 0.0}, vec3(3.0F)}}, 1).value, 3.0 * std::sqrt(0.5),
              1e-3);
}

TEST_F(Plane, BallOfLight) {
  SceneLight lamp{LIGHT_POINT, {0.5, 1.2, 0.0}, vec3(3.0F)};
  lamp.size = 0.4;
  const double distance = glm::length(lamp.position), cosine = lamp.position.y / distance;
  const Mean found = irradiance({lamp}, 4096);
  // A ball that is all above the plane lights it as if its light came from its middle.
  EXPECT_NEAR(found.value, 3.0 * cosine / (distance * distance), 1e-3 * found.value + 3.0 * found.error);
}

TEST_F(Plane, SunWithASize) {
  SceneLight sun{LIGHT_DIRECTIONAL, {1.0, 1.0, 0.0}, vec3(3.0F)};
  sun.size = 0.2;
  const Mean found = irradiance({sun}, 4096);
  EXPECT_NEAR(found.value, 3.0 * std::sqrt(0.5), 1e-3 * found.value + 3.0 * found.error);
}

TEST_F(Plane, RectangleOfLight) {
  SceneLight lamp{LIGHT_RECTANGLE, {0.5, 1.0, 0.25}, vec3(5.0F)};
  lamp.edge_u = {0.5, 0.0, 0.0};
  lamp.edge_v = {0.0, 0.0, 0.25};  // cross(u, v) = -y
  // Its corner is above the point: Siegel and Howell, configuration B-3 with a = width / height, b = depth / height.
  const double a = 1.0, b = 0.5, p = std::sqrt(1.0 + a * a), q = std::sqrt(1.0 + b * b);
  const double form_factor = (a / p * std::atan(b / p) + b / q * std::atan(a / q)) / (2.0 * pi);
  const Mean found = irradiance({lamp}, 4096);
  EXPECT_NEAR(found.value, pi * 5.0 * form_factor, 1e-3 * found.value + 3.0 * found.error);
}

/// The floor alone sends no light back to itself: what it gets straight from lights is all there is, however few bounces there are.
TEST_F(Plane, WithoutBouncesAllDirectLightArrives) {
  bounces_ = 0;
  SceneLight lamp{LIGHT_POINT, {0.6, 0.7, 0.0}, vec3(3.0F)};
  lamp.size = 0.5;
  SceneLight sun{LIGHT_DIRECTIONAL, {1.0, 1.0, 0.0}, vec3(3.0F)};
  sun.size = 0.5;
  SceneLight panel{LIGHT_RECTANGLE, {0.5, 0.5, 0.25}, vec3(5.0F)};
  panel.edge_u = {0.5, 0.0, 0.0};
  panel.edge_v = {0.0, 0.0, 0.25};  // cross(u, v) = -y
  const double distance = glm::length(lamp.position), a = 2.0, b = 1.0;
  const double p = std::sqrt(1.0 + a * a), q = std::sqrt(1.0 + b * b);
  const double form_factor = (a / p * std::atan(b / p) + b / q * std::atan(a / q)) / (2.0 * pi);
  const auto expect = [](const char* of, const Mean& found, double expected) {
    EXPECT_NEAR(found.value, expected, 1e-3 * expected + 3.0 * found.error) << of;
    EXPECT_LT(found.error, 0.01 * expected) << of;
  };
  expect("a ball", irradiance({lamp}, 1024), 3.0 * lamp.position.y / std::pow(distance, 3.0));
  expect("a sun", irradiance({sun}, 1024), 3.0 * std::sqrt(0.5));
  expect("a rectangle", irradiance({panel}, 1024), pi * 5.0 * form_factor);
  expect("one radiance", irradiance({}, 64, constant(2.0F)), 2.0 * pi);
  expect("a picture", irradiance({}, 1024, {64, 32, std::vector<glm::vec3>(64 * 32, vec3(2.0F)), vec3(0.0F)}),
         2.0 * pi);
  const dvec3 at(0.6, 0.8, 0.0);
  Scene glowing = scene_of({floor(), {ball_at(at, 0.4, 5000), grey(0.0F)}});
  glowing.materials.back().emission = vec3(4.0F);
  show(glowing, constant(0.0F), {});
  // Discs reach a little beyond the ball that they stand for.
  const Mean splats = irradiance_shown(1024);
  const double of_splats = pi * 4.0 * 0.4 * 0.4 * at.y / std::pow(glm::length(at), 3.0);
  EXPECT_NEAR(splats.value, of_splats, 5e-3 * of_splats + 3.0 * splats.error);
}

/// Light that only rays meet: a mirror shows it at its last bounce, too.
TEST_F(Plane, WithoutBouncesMirrorsShowWhatSendsOutLight) {
  Scene scene = scene_of({floor()});
  Material& mirror = scene.materials.front();
  mirror.base = vec3(1.0F);
  mirror.metallic = 1.0F;
  mirror.roughness = 0.0F;
  const Environment sky{64, 32, std::vector<glm::vec3>(64 * 32, vec3(2.0F)), vec3(0.0F)};
  const std::vector<std::pair<const char*, Environment>> skies = {{"one radiance", constant(2.0F)},
                                                                  {"a picture", sky}};
  for (const auto& [name, environment] : skies) {
    show(scene, environment, {});
    Settings settings = lit(4);
    settings.max_bounces = 0;
    const Camera above{dvec3(0.0, 1.5, 0.0), dvec3(0.0), dvec3(0.0, 0.0, -1.0), 30.0, 0.001};
    EXPECT_NEAR(mean_of(picture(above, settings, 4)).value, 2.0, 1e-3) << name;
  }
}

/// From the plane's middle all of one light lies behind another, which has a size.
TEST_F(Plane, LightsHideWhatIsBehindThem) {
  SceneLight before{LIGHT_POINT, {0.5, 0.5, 0.0}, vec3(1.0F)},
      behind{LIGHT_POINT, {1.0, 1.0, 0.0}, vec3(8.0F)};
  before.size = 0.3;
  behind.size = 0.2;
  SceneLight panel{LIGHT_RECTANGLE, {-0.8, 0.8, 0.0}, vec3(5.0F)}, hidden = behind;
  panel.edge_u = {0.0, 0.0, 0.6};
  panel.edge_v = {-0.6, -0.6, 0.0};  // cross(u, v) points to +x, -y
  hidden.position = {-1.2, 1.2, 0.0};
  SceneLight sun{LIGHT_DIRECTIONAL, {1.0, 1.0, 0.0}, vec3(3.0F)};
  for (const auto& [seen, unseen] :
       {std::pair(before, behind), std::pair(panel, hidden), std::pair(before, sun)}) {
    const Mean alone = irradiance({seen}, 1024), both = irradiance({seen, unseen}, 1024);
    EXPECT_NEAR(both.value, alone.value, 1e-3 * alone.value + 3.0 * (alone.error + both.error));
  }
}

TEST_F(Plane, LightsHideThePartOfAnotherThatIsBehindThem) {
  // Seen from the plane's middle both are discs about one direction, the farther one wider.
  const dvec3 towards(0.6, 0.8, 0.0);
  SceneLight before{LIGHT_POINT, towards, vec3(1.0F)}, behind{LIGHT_POINT, 3.0 * towards, vec3(9.0F)};
  before.size = 0.2;
  behind.size = 0.9;
  const Mean found = irradiance({before, behind}, 4096);
  const double hidden = 0.2 * 0.2, wide = 0.3 * 0.3;  // squared sines
  const double expected = towards.y * (1.0 + 1.0 - hidden / wide);
  EXPECT_NEAR(found.value, expected, 1e-3 * expected + 3.0 * found.error);
}

TEST_F(Plane, ManyLightsOfAllKinds) {
  SPLATRAY_NIGHTLY();
  std::vector<SceneLight> lights;
  double expected = 0.0;
  for (int i = 0; i < 40; ++i) {
    const double angle = 2.4 * i, height = 1.0 + 0.05 * i;  // none is in another's way
    SceneLight light{
        i % 2 == 0 ? LIGHT_POINT : LIGHT_DIRECTIONAL, {std::cos(angle), height, std::sin(angle)}, vec3(0.1F)};
    light.size = i % 3 == 0 ? 0.05 : 0.0;
    const double distance = glm::length(light.position), cosine = height / distance;
    expected += 0.1 * cosine / (i % 2 == 0 ? distance * distance : 1.0);
    lights.push_back(light);
  }
  const Mean found = irradiance(lights, 4096);
  EXPECT_NEAR(found.value, expected, 1e-3 * expected + 3.0 * found.error);
}

TEST_F(Plane, EnvironmentWithABrightSpot) {
  Environment sky{64, 32, std::vector<glm::vec3>(64 * 32, vec3(0.2F)), vec3(0.0F)};
  sky.texels[10 * 64 + 20] = vec3(300.0F);
  double expected = 0.0;
  constexpr int STEPS = 16;  // of a texel, which filtering blends with its neighbours
  const auto texel = [&](int column, int row) {
    return double(sky.texels[std::size_t(std::clamp(row, 0, 31) * 64 + (column + 64) % 64)].x);
  };
  for (int row = 0; row < 32 * STEPS; ++row)
    for (int column = 0; column < 64 * STEPS; ++column) {
      const double x = (column + 0.5) / STEPS - 0.5, y = (row + 0.5) / STEPS - 0.5;
      const int x0 = int(std::floor(x)), y0 = int(std::floor(y));
      const double on_x = x - x0, on_y = y - y0;
      const double radiance = (texel(x0, y0) * (1 - on_x) + texel(x0 + 1, y0) * on_x) * (1 - on_y) +
                              (texel(x0, y0 + 1) * (1 - on_x) + texel(x0 + 1, y0 + 1) * on_x) * on_y;
      const double theta = pi * (row + 0.5) / (32 * STEPS);
      expected += radiance * std::max(std::cos(theta), 0.0) * std::sin(theta) * pi / (32 * STEPS) * 2.0 * pi /
                  (64 * STEPS);
    }
  const Mean found = irradiance({}, 4096, sky);
  EXPECT_NEAR(found.value, expected, 2e-3 * expected + 3.0 * found.error);
  EXPECT_LT(found.error, 0.01 * expected);
}

/// A ball is lit by the environment as before whatever is seen beside it.
TEST_F(Lit, BackgroundsAreSeenAndGiveNoLight) {
  show(ball(0.5F, 2000), constant(1.0F), {});
  const Camera camera{{0.0, 0.0, 5.0}, {}, {0.0, 1.0, 0.0}, 60.0, 0.0};
  Settings settings = lit(4);
  const Image before = picture(camera, settings, 32);
  settings.background = vec3(0.25F, 0.5F, 2.0F);
  const Image colored = picture(camera, settings, 32);
  settings.background.reset();
  settings.transparent = true;
  const Image transparent = picture(camera, settings, 32);
  EXPECT_EQ(vec3(before.rgba[0]), vec3(1.0F));
  EXPECT_EQ(vec3(colored.rgba[0]), vec3(0.25F, 0.5F, 2.0F));
  EXPECT_EQ(transparent.rgba[0], vec4(0.0F));
  const std::size_t middle = 16 * 32 + 16;
  EXPECT_EQ(transparent.rgba[middle], before.rgba[middle]);
  for (std::size_t i = 0; i < before.rgba.size(); ++i)
    EXPECT_NEAR(before.rgba[i].x, transparent.rgba[i].x + (1.0F - transparent.rgba[i].w), 1e-5F);
}

/// A path's light after its first bounce is bounded, what comes before is as it was.
TEST_F(Lit, ClampBoundsWhatComesAfterTheFirstBounce) {
  show(ball(0.8F, 2000), constant(0.0F), {{LIGHT_POINT, dvec3(0.3, 0.2, 0.25), vec3(1.0F)}});
  const Camera inside{{}, {0.0, 0.0, -1.0}, {0.0, 1.0, 0.0}, 60.0, 0.0};
  Settings settings = lit(16);
  const double all = mean_of(picture(inside, settings, 8)).value;
  settings.clamp = 1e-6F;
  const double bounded = mean_of(picture(inside, settings, 8)).value;
  settings.clamp = 0.0F;
  settings.max_bounces = 0;
  const double direct = mean_of(picture(inside, settings, 8)).value;
  EXPECT_NEAR(bounded, direct, 1e-4 * direct);
  EXPECT_GT(all, 2.0 * direct);
}

}  // namespace
}  // namespace splatray::testing
