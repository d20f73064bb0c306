// Rays against the root and its cells: along their faces, edges and corners; origins in, on and outside the
// root; eyes far away; trees as deep as they get.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "data/shapes.h"
#include "engine/scene/splat.h"
#include "tests/hard/support/clouds.h"
#include "tests/hard/support/device_scene.h"
#include "tests/hard/support/lattice_soup.h"

namespace splatray::testing {
namespace {

using glm::dvec3;

constexpr double EDGE = 1U << LATTICE_BITS;
constexpr std::size_t RAYS = 40000;

TEST(Cell, RaysInFaces) {
  const Scene scene = lattice_soup();
  DeviceScene device(scene);
  std::mt19937_64 random(11);
  std::vector<RayQuery> rays;
  for (std::size_t i = 0; i < RAYS; ++i) {
    dvec3 dir = random_unit(random);
    dir[static_cast<int>(i % 3)] = 0.0;
    rays.push_back(primary_ray(lattice_point(random), dir));
  }
  conclude(compare_with_brute_force(device, BruteForce(scene), rays, "rays within cell planes"));
}

TEST(Cell, RaysThroughCorners) {
  const Scene scene = lattice_soup();
  DeviceScene device(scene);
  std::mt19937_64 random(13);
  std::vector<RayQuery> rays;
  for (std::size_t i = 0; i < RAYS; ++i) {
    const dvec3 origin = lattice_point(random);
    rays.push_back(primary_ray(origin, lattice_point(random) - origin + dvec3(0.5, 0.0, 0.0)));
    dvec3 diagonal(1.0, random() % 2 == 0 ? 1.0 : -1.0, random() % 2 == 0 ? 1.0 : -1.0);
    diagonal *= dvec3(1.0, double(random() % 3), double(random() % 3));
    rays.push_back(primary_ray(origin, diagonal));
  }
  conclude(compare_with_brute_force(device, BruteForce(scene), rays, "rays from corner to corner"));
}

TEST(Origin, InOnAndOutsideTheRoot) {
  const Scene scene = lattice_soup();
  DeviceScene device(scene);
  const auto limit = static_cast<float>(EDGE);
  const std::vector<float> places = {0.0F,
                                     -0.0F,
                                     std::nextafter(0.0F, 1.0F),
                                     std::nextafter(0.0F, -1.0F),
                                     limit,
                                     std::nextafter(limit, 0.0F),
                                     std::nextafter(limit, 2.0F * limit),
                                     0.5F * limit,
                                     -limit,
                                     2.0F * limit};
  std::mt19937_64 random(17);
  std::vector<RayQuery> rays;
  for (std::size_t i = 0; i < RAYS; ++i) {
    dvec3 origin;
    for (int axis = 0; axis < 3; ++axis) origin[axis] = double(places[random() % places.size()]);
    const dvec3 target = EDGE * (0.5 + 0.4 * random_unit(random));
    rays.push_back(primary_ray(origin, i % 4 == 0 ? random_unit(random) : target - origin));
  }
  conclude(
      compare_with_brute_force(device, BruteForce(scene), rays, "corners, faces and ±1 ulp of the root"));
}

TEST(Origin, OnSplats) {
  const Scene scene = lattice_soup();
  const BruteForce brute(scene);
  DeviceScene device(scene);
  std::mt19937_64 random(19);
  std::vector<RayQuery> rays;
  for (std::size_t i = 0; i < RAYS; ++i) {
    const Splat& splat = brute.splats()[random() % brute.splats().size()];
    rays.push_back(primary_ray(splat.center, random_unit(random)));
  }
  conclude(compare_with_brute_force(device, brute, rays, "origins at splat centres, where t = 0 is no hit"));
}

/// n.(c - o) = 0 and n.d = 0 but for rounding: the hit is at t = 0 exactly, before t_min, however small n.d is.
TEST(Origin, OnSplatsInTheirPlane) {
  const Scene scene = lattice_soup();
  const BruteForce brute(scene);
  DeviceScene device(scene);
  std::mt19937_64 random(23);
  std::uniform_real_distribution<float> t_min(0.0F, 1.0F);
  std::vector<RayQuery> rays;
  for (std::size_t i = 0; i < RAYS; ++i) {
    const Splat& splat = brute.splats()[random() % brute.splats().size()];
    RayQuery ray = primary_ray(splat.center, glm::cross(splat.normal, random_unit(random)));
    ray.t_min = t_min(random);
    rays.push_back(ray);
  }
  conclude(compare_with_brute_force(device, brute, rays,
                                    "origins at splat centres, in the discs' planes, t_min in 0..1"));
}

/// As above where a part of the ray behind its origin counts too, so that the first splat met is often edge-on: what it
/// blends with is then a matter of rounding.
TEST(Origin, OnSplatsInTheirPlaneWithNegativeStart) {
  const Scene scene = lattice_soup();
  const BruteForce brute(scene);
  DeviceScene device(scene);
  std::mt19937_64 random(29);
  std::uniform_real_distribution<float> exponent(-10.0F, 23.0F);
  std::vector<RayQuery> rays;
  for (std::size_t i = 0; i < RAYS; ++i) {
    const Splat& splat = brute.splats()[random() % brute.splats().size()];
    RayQuery ray = primary_ray(splat.center, glm::cross(splat.normal, random_unit(random)));
    ray.t_min = i % 8 == 0 ? -std::numeric_limits<float>::infinity() : -std::exp2(exponent(random));
    rays.push_back(ray);
  }
  conclude(compare_with_brute_force(
      device, brute, rays, "origins at splat centres, in the discs' planes, t_min below 0", Compared::hits));
}

/// Secondary rays from so far outside that the root's discs, however large, are not the sheet they left.
TEST(Origin, SecondaryRaysFromFarOutside) {
  std::mt19937_64 random(31);
  std::uniform_real_distribution<double> inside(0.3, 0.7), distance(2.2, 3.0), radius(0.2, 0.4);
  const auto point = [&] { return EDGE * dvec3(inside(random), inside(random), inside(random)); };
  std::vector<Disc> discs;
  for (int i = 0; i < 100; ++i)
    discs.push_back({glm::round(point()), random_unit(random), EDGE * radius(random)});
  const Scene scene = lattice_scene(discs, test_material(MATERIAL_TWO_SIDED), 4);
  const BruteForce brute(scene);
  DeviceScene device(scene);
  std::vector<RayQuery> rays;
  for (std::size_t i = 0; i < RAYS; ++i) {
    const dvec3 target = point();
    const dvec3 origin = dvec3(EDGE / 2.0) + distance(random) * EDGE * random_unit(random);
    RayQuery ray = primary_ray(origin, target - origin);
    ray.from_object = 0;
    ray.from_normal = vec3(random_unit(random));
    rays.push_back(ray);
  }
  conclude(compare_with_brute_force(device, brute, rays, "origins more than a root's side outside",
                                    Compared::hits));
}

/// Errors of a picture's depth and normals against the exact sphere, silhouette apart.
struct PictureErrors {
  std::uint64_t pixels = 0;
  std::uint64_t mismatches = 0;  ///< hit where the sphere is missed or the other way round
  double depth_rms = 0.0;        ///< in radii of the sphere
  double normal_rms_deg = 0.0;
};

PictureErrors errors_of(const Image& image, const View& view, double radius) {
  PictureErrors errors;
  const Camera& camera = view.camera;
  const dvec3 forward = glm::normalize(camera.target - camera.eye);
  const dvec3 right = glm::normalize(glm::cross(forward, camera.up));
  const dvec3 up = glm::cross(right, forward);
  const double half = std::tan(glm::radians(camera.fov_y_deg) / 2.0);
  double hits = 0.0;
  for (std::uint32_t i = 0; i < view.width * view.height; ++i) {
    const double x = (i % view.width + 0.5) / view.width * 2.0 - 1.0;
    const double y = 1.0 - (i / view.width + 0.5) / view.height * 2.0;
    const dvec3 dir = glm::normalize(forward + half * (x * right + y * up));
    const double along = -glm::dot(camera.eye, dir);
    const dvec3 nearest = camera.eye + along * dir;
    const double left = radius * radius - glm::dot(nearest, nearest);
    if (std::abs(left) < 0.05 * radius * radius) continue;  // the silhouette
    const AovPixel& pixel = image.aov[i];
    ++errors.pixels;
    errors.mismatches += (pixel.object != NO_OBJECT) != (left > 0.0) ? 1 : 0;
    if (left < 0.0 || pixel.object == NO_OBJECT) continue;
    const double t = along - std::sqrt(left);
    const dvec3 normal = (camera.eye + t * dir) / radius;
    const double sine = glm::length(glm::cross(normal, glm::normalize(dvec3(pixel.normal))));
    errors.depth_rms += std::pow((double(pixel.z) - t) / radius, 2.0);
    errors.normal_rms_deg += std::pow(glm::degrees(std::asin(std::min(sine, 1.0))), 2.0);
    hits += 1.0;
  }
  errors.depth_rms = std::sqrt(errors.depth_rms / hits);
  errors.normal_rms_deg = std::sqrt(errors.normal_rms_deg / hits);
  return errors;
}

TEST(Origin, FarEyes) {
  const Scene scene = scene_of({{sphere({.count = 20000}, 1.0), test_material(0)}});
  DeviceScene device(scene);
  Settings settings;
  settings.samples = 1;
  settings.aov = true;
  PictureErrors near;
  for (const double distance : {3.0, 1e2, 1e4, 1e6}) {
    View view{{.eye = distance * glm::normalize(dvec3(1.0, 0.7, 0.4))}, 256, 256};
    view.camera.fov_y_deg = glm::degrees(2.0 * std::atan(1.2 / distance));
    const Image image = device.render(view, settings, {});
    const PictureErrors errors = errors_of(image, view, 1.0);
    if (near.pixels == 0) near = errors;
    CaseRow row = device.row("hit or miss, exact sphere, eye " + short_number(distance) + " radii away");
    row.count = errors.pixels;
    row.unit = "pixels";
    row.exceptions = errors.mismatches;
    row.remark = "normal rms " + short_number(errors.normal_rms_deg) + "°, depth rms " +
                 short_number(errors.depth_rms) + " R";
    conclude(row);
    EXPECT_LT(errors.normal_rms_deg, 1.1 * near.normal_rms_deg) << distance;
    // Depth is a float32 distance from the eye: its own rounding grows with the distance.
    EXPECT_LT(errors.depth_rms, 1.1 * near.depth_rms + 0x1p-23 * distance) << distance;
  }
}

/// Rays at the splats' surroundings from random points `away` from them.
std::vector<RayQuery> rays_from(const BruteForce& brute, double away) {
  std::mt19937_64 random(29);
  std::vector<RayQuery> rays;
  for (std::size_t i = 0; i < RAYS; ++i) {
    const dvec3 target = brute.splats()[random() % brute.splats().size()].center + random_unit(random);
    const dvec3 origin = target + away * random_unit(random);
    rays.push_back(primary_ray(origin, target - origin));
  }
  return rays;
}

TEST(Origin, DeepTree) {
  std::mt19937_64 random(23);
  std::vector<Disc> discs;
  for (int i = 0; i < 1500; ++i) {
    const auto place = [&] { return 1000000.0 + double(random() % 40); };
    discs.push_back({{place(), place(), place()}, random_unit(random), 2.0});
  }
  const Scene scene = lattice_scene(discs, test_material(MATERIAL_TWO_SIDED), 4);
  const BruteForce brute(scene);
  DeviceScene device(scene);
  conclude(compare_with_brute_force(device, brute, rays_from(brute, 100.0),
                                    "1500 discs within 40 lattice units, from near"));
  conclude(compare_with_brute_force(device, brute, rays_from(brute, 3e6), "the same from outside the root",
                                    Compared::hits));
}

}  // namespace
}  // namespace splatray::testing
