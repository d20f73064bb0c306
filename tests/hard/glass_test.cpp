// Glass against exact paths: what pixels show on average, total reflection, nesting, touching, holes.
#include <gtest/gtest.h>

#include <cmath>

#include "data/shapes.h"
#include "tests/all_tests.h"
#include "tests/hard/support/clouds.h"
#include "tests/hard/support/device_scene.h"
#include "tests/hard/support/expected_radiance.h"

namespace splatray::testing {
namespace {

using glm::dvec3;

constexpr double STANDARD_ERRORS_ASKED = 3.0;
constexpr double STANDARD_ERRORS = 4.0;
constexpr double BENT = 0.004;  ///< radiance that normals of splats, a little off the exact ones, may change

/// An environment that says where a ray went: radiance 1/2 + direction / 2.
dvec3 direction_code(const dvec3& dir) { return 0.5 + 0.5 * dir; }

Environment direction_environment() {
  Environment environment{512, 256, {}, vec3(0.0F)};
  for (std::uint32_t row = 0; row < environment.height; ++row)
    for (std::uint32_t column = 0; column < environment.width; ++column)
      environment.texels.emplace_back(direction_code(glm::normalize(dvec3(environment_direction(
          float((column + 0.5) / environment.width), float((row + 0.5) / environment.height))))));
  return environment;
}

/// A ray whose radiance is asked for.
struct Probe {
  dvec3 origin;
  dvec3 dir;
};

/// Mean radiance of 64 x 64 pixels x 16 samples that all lie within 1e-4 of the ray, and its standard error
/// were the samples independent.
struct Measured {
  dvec3 mean{0.0};
  dvec3 standard_error{0.0};
};

Measured measure(DeviceScene& device, const Probe& probe) {
  View view{{.eye = probe.origin, .target = probe.origin + probe.dir}, hard_width(64), hard_width(64)};
  view.camera.up = std::abs(probe.dir.y) < 0.9 ? dvec3(0.0, 1.0, 0.0) : dvec3(1.0, 0.0, 0.0);
  view.camera.ortho_height = 1e-4;
  Settings settings;
  settings.max_bounces = 64;
  const Image image = device.render(view, settings, direction_environment());
  Measured measured;
  dvec3 squares(0.0);
  for (const vec4& pixel : image.rgba) {
    measured.mean += dvec3(pixel);
    squares += dvec3(pixel) * dvec3(pixel);
  }
  const double count = double(image.rgba.size());
  measured.mean /= count;
  measured.standard_error = glm::sqrt(glm::max(squares / count - measured.mean * measured.mean, 0.0) / count);
  return measured;
}

/// Probes whose measured radiance is not the exact one: within 3 standard errors as is asked of the method, and within 4 and
/// what splats' normals may bend.
struct WrongRadiance {
  CaseRow asked, bent;
};

WrongRadiance compare_radiance(const Scene& scene, const std::vector<Body>& bodies,
                               const std::vector<Probe>& probes, const std::string& compared) {
  DeviceScene device(scene);
  CaseRow row;
  double largest = 0.0;
  std::uint64_t outside = 0;
  for (const Probe& probe : probes) {
    const Measured measured = measure(device, probe);
    const dvec3 expected = expected_radiance(bodies, probe.origin, probe.dir, direction_code);
    const dvec3 error = glm::abs(measured.mean - expected);
    const dvec3 allowed = STANDARD_ERRORS * measured.standard_error + BENT;
    row.exceptions += glm::any(glm::greaterThan(error, allowed)) ? 1 : 0;
    outside += glm::any(glm::greaterThan(error, STANDARD_ERRORS_ASKED * measured.standard_error)) ? 1 : 0;
    largest = std::max({largest, error.x, error.y, error.z});
  }
  const CaseRow troubles = device.row("");
  row.compared = compared;
  row.count = probes.size();
  row.unit = "rays x 65 536 samples";
  row.lost = troubles.lost;
  row.non_finite = troubles.non_finite;
  row.remark = "largest error " + short_number(largest) + ", " +
               std::to_string(device.counter(COUNT_LEAKED)) + " leaked";
  CaseRow asked = row;
  asked.compared += ", within 3 standard errors";
  asked.exceptions = outside;
  row.compared += ", within 4 standard errors and " + short_number(BENT);
  return {asked, row};
}

void conclude_radiance(const WrongRadiance& wrong, std::uint64_t known) {
  conclude_missed(wrong.asked, known);
  conclude(wrong.bent);
}

/// `count` rays from 3 away at points of a ball of this radius about a centre.
std::vector<Probe> probes_at(const dvec3& center, double radius, std::size_t count) {
  std::mt19937_64 random(1);
  std::vector<Probe> probes;
  while (probes.size() < count) {
    const dvec3 dir = random_unit(random);
    probes.push_back({center + radius * random_unit(random) - 3.0 * dir, dir});
  }
  return probes;
}

OrientedPoints box_points(const dvec3& size, double density) {
  OrientedPoints points;
  for (const SurfacePatch& face : box("box", size, false))
    append(points, face.make({.count = static_cast<std::uint64_t>(density * face.area)}));
  return points;
}

Body box_body(const dvec3& half, double ior) {
  std::vector<HalfSpace> planes;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      dvec3 normal(0.0);
      normal[axis] = side;
      planes.push_back({normal, half[axis]});
    }
  }
  return convex_body(planes, ior);
}

TEST(Glass, Sphere) {
  const Scene scene = scene_of({{sphere({.count = 40000}, 1.0), glass_material(1.5F)}});
  conclude_radiance(
      compare_radiance(scene, {sphere_body(dvec3(0.0), 1.0, 1.5)}, probes_at(dvec3(0.0), 0.6, 12),
                       "radiance through a sphere, exact paths"),
      0);
}

/// Light that enters a flat slab at its narrow side is guided by total reflection.
TEST(Glass, TotalReflectionInASlab) {
  const dvec3 half(0.5, 0.1, 0.5);
  const Scene scene = scene_of({{box_points(2.0 * half, 8000.0), glass_material(1.5F)}});
  std::vector<Probe> probes;
  for (const double angle_deg : {5.0, 15.0, 25.0, 35.0, 45.0}) {
    const dvec3 dir(std::cos(glm::radians(angle_deg)), -std::sin(glm::radians(angle_deg)), 0.0);
    probes.push_back({dvec3(-0.5, 0.013, 0.02) - 2.0 * dir, dir});
  }
  conclude_radiance(compare_radiance(scene, {box_body(half, 1.5)}, probes,
                                     "radiance through a slab from its side, exact paths"),
                    5);
}

/// Right-angled prism, legs of length 1 along x and y, height 1 along z; a ray into one leg is turned by 90 degrees.
TEST(Glass, TotalReflectionInA45DegreePrism) {
  const auto face = [](dvec3 corner, dvec3 u, dvec3 v) { return rectangle({.count = 6000}, corner, u, v); };
  OrientedPoints points = face({0, 0, 0}, {0, 0, 1}, {0, 1, 0});  // x = 0, normal -x
  append(points, face({0, 0, 0}, {1, 0, 0}, {0, 0, 1}));          // y = 0, normal -y
  append(points, face({1, 0, 0}, {-1, 1, 0}, {0, 0, 1}));         // the long side
  const auto triangle = [](const dvec3& at) { return at.x + at.y < 1.0; };
  append(points, kept(face({0, 0, 0}, {0, 1, 0}, {1, 0, 0}), triangle));  // z = 0, normal -z
  append(points, kept(face({0, 0, 1}, {1, 0, 0}, {0, 1, 0}), triangle));  // z = 1, normal +z
  const double slant = std::sqrt(0.5);
  const Body prism = convex_body(
      {{{-1, 0, 0}, 0.0}, {{0, -1, 0}, 0.0}, {{slant, slant, 0}, slant}, {{0, 0, -1}, 0.0}, {{0, 0, 1}, 1.0}},
      1.5);
  std::vector<Probe> probes;
  for (const double tilt : {0.0, 0.02, -0.02, 0.05}) {
    const dvec3 dir = glm::normalize(dvec3(1.0, tilt, 0.5 * tilt));
    probes.push_back({dvec3(0.0, 0.41, 0.52) - 2.0 * dir, dir});
  }
  conclude_radiance(compare_radiance(scene_of({{points, glass_material(1.5F)}}), {prism}, probes,
                                     "radiance through a 45 degree prism, exact paths"),
                    4);
}

/// The inner one stands first in the scene, so that its bit comes from its size.
TEST(Glass, NestedGlassInWater) {
  SPLATRAY_NIGHTLY();
  const Scene scene = scene_of({{sphere({.count = 20000}, 0.5), glass_material(1.5F)},
                                {sphere({.count = 40000}, 1.0), glass_material(1.33F)}});
  conclude_radiance(
      compare_radiance(scene, {sphere_body(dvec3(0.0), 1.0, 1.33), sphere_body(dvec3(0.0), 0.5, 1.5)},
                       probes_at(dvec3(0.0), 0.3, 12), "radiance through glass in water, exact paths"),
      0);
}

/// A bubble is a boundary of the same object whose normals point into it, out of the glass.
TEST(Glass, BubbleInGlass) {
  SPLATRAY_NIGHTLY();
  OrientedPoints points = sphere({.count = 40000}, 1.0);
  append(points, flipped(sphere({.count = 20000}, 0.5)));
  conclude_radiance(
      compare_radiance(scene_of({{points, glass_material(1.5F)}}),
                       {sphere_body(dvec3(0.0), 1.0, 1.5), sphere_body(dvec3(0.0), 0.5, 1.0)},
                       probes_at(dvec3(0.0), 0.3, 12), "radiance through a bubble in glass, exact paths"),
      0);
}

/// Two slabs with a common face: light that passes both straight.
TEST(Glass, TouchingSlabs) {
  SPLATRAY_NIGHTLY();
  const dvec3 half(0.5, 0.1, 0.5);
  const OrientedPoints slab = box_points(2.0 * half, 8000.0);
  const Scene scene = scene_of({{moved(slab, {0.0, 0.1, 0.0}), glass_material(1.5F)},
                                {moved(slab, {0.0, -0.1, 0.0}), glass_material(1.5F)}});
  // Of the same glass, so that the common face changes nothing.
  const Body both = box_body({0.5, 0.2, 0.5}, 1.5);
  std::vector<Probe> probes;
  for (const double tilt : {0.0, 0.1, 0.3}) {
    const dvec3 dir = glm::normalize(dvec3(tilt, -1.0, 0.1));
    probes.push_back({dvec3(0.01, 0.2, 0.02) - 2.0 * dir, dir});
  }
  conclude_radiance(
      compare_radiance(scene, {both}, probes, "radiance through two slabs that touch, one slab of both"), 3);
}

/// Glass on a table: the sphere touches a mirror-free plane of another object; no path may get under it.
TEST(Glass, OnATable) {
  SPLATRAY_NIGHTLY();
  OrientedPoints table = rectangle({.count = 20000}, {-1.5, -1.0, 1.5}, {3, 0, 0}, {0, 0, -3});
  const Scene scene =
      scene_of({{sphere({.count = 40000}, 1.0), glass_material(1.5F)}, {table, test_material(0)}});
  DeviceScene device(scene);
  Settings settings;
  settings.max_bounces = 32;
  const View view{{.eye = {0.0, 0.5, 4.0}, .target = {0.0, -0.3, 0.0}}, 128, 128};
  const Image image = device.render(view, settings, {0, 0, {}, vec3(1.0F)});
  CaseRow row = device.row("paths that leave the scene while inside glass");
  row.count = image.rgba.size() * settings.samples;
  row.unit = "paths";
  row.exceptions = device.counter(COUNT_LEAKED);
  conclude(row);
}

/// A glass bowl: paths that leave through the open side are counted as leaked, and stay finite.
TEST(Glass, UnclosedGlassLeaks) {
  const OrientedPoints bowl = kept(sphere({.count = 20000}, 1.0), [](const dvec3& at) { return at.y < 0.3; });
  DeviceScene device(scene_of({{bowl, glass_material(1.5F)}}));
  const View view{{.eye = {0.0, 2.0, 3.0}, .target = {0.0, 0.0, 0.0}}, 128, 128};
  const Image image = device.render(view, {}, {0, 0, {}, vec3(1.0F)});
  CaseRow row = device.row("paths that leave an open bowl while inside its glass");
  row.count = image.rgba.size() * Settings{}.samples;
  row.unit = "paths";
  row.exceptions = device.counter(COUNT_LEAKED);
  conclude_failing(row);
}

TEST(Glass, AnotherIndexIsNoticed) {
  const Scene scene = scene_of({{sphere({.count = 40000}, 1.0), glass_material(1.45F)}});
  conclude_failing(compare_radiance(scene, {sphere_body(dvec3(0.0), 1.0, 1.5)}, probes_at(dvec3(0.0), 0.6, 6),
                                    "radiance through glass of index 1.45, exact paths of 1.5")
                       .bent);
}

}  // namespace
}  // namespace splatray::testing
