// The truth of a mesh tends to that of the shape it approximates.
#include <gtest/gtest.h>

#include <iostream>

#include "tests/bench/cases/statistics.h"
#include "tests/bench/truth/analytic.h"
#include "tests/bench/truth/mesh_truth.h"

namespace splatray::testing {
namespace {

/// The unit sphere as an octahedron whose triangles are cut in four `levels` times.
Mesh sphere_mesh(int levels) {
  Mesh mesh;
  const auto add = [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, int left,
                       const auto& self) -> void {
    if (left > 0) {
      const glm::dvec3 ab = glm::normalize(a + b), bc = glm::normalize(b + c), ca = glm::normalize(c + a);
      self(a, ab, ca, left - 1, self);
      self(ab, b, bc, left - 1, self);
      self(ca, bc, c, left - 1, self);
      self(ab, bc, ca, left - 1, self);
      return;
    }
    const auto first = static_cast<glm::uint>(mesh.vertices.position.size());
    for (const glm::dvec3& corner : {a, b, c}) mesh.vertices.position.push_back(corner);
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  };
  for (int octant = 0; octant < 8; ++octant) {
    const double x = (octant & 1) != 0 ? -1.0 : 1.0, y = (octant & 2) != 0 ? -1.0 : 1.0,
                 z = (octant & 4) != 0 ? -1.0 : 1.0;
    const glm::dvec3 a(x, 0.0, 0.0), b(0.0, y, 0.0), c(0.0, 0.0, z);
    const bool turned = x * y * z < 0.0;
    add(a, turned ? c : b, turned ? b : c, levels, add);
  }
  return mesh;
}

struct Distance {
  double depth_median, normal_median_deg;
  std::size_t mismatches;
};

/// How far the mesh's truth is from the sphere's, off silhouettes.
Distance distance_from_sphere(int levels) {
  View view;
  view.camera.eye = {0.8, 1.5, 3.0};
  view.width = view.height = 64;
  const Truth sphere = analytic_truth(Shape::sphere, view);
  const Truth mesh = mesh_truth(sphere_mesh(levels), view);
  std::vector<double> depths, angles;
  std::size_t mismatches = 0;
  for (std::size_t i = 0; i < sphere.pixels.size(); ++i) {
    const TruePixel& wanted = sphere.pixels[i];
    const TruePixel& found = mesh.pixels[i];
    mismatches += wanted.hit() != found.hit() ? 1 : 0;
    if (!wanted.hit() || wanted.edge || !found.hit()) continue;
    depths.push_back(std::abs(found.depth_world - wanted.depth_world));
    angles.push_back(angle_deg(found.normal_world, wanted.normal_world));
  }
  return {quantile(depths, 0.5), quantile(angles, 0.5), mismatches};
}

TEST(MeshTruth, OfFinerSpheresTendsToTheSphereWithTheSquareOfTheEdge) {
  Distance coarse = distance_from_sphere(4);
  for (const int levels : {5, 6, 7}) {
    const Distance fine = distance_from_sphere(levels);
    EXPECT_NEAR(coarse.depth_median / fine.depth_median, 4.0, 0.6) << levels;
    EXPECT_NEAR(coarse.normal_median_deg / fine.normal_median_deg, 4.0, 1.0) << levels;
    EXPECT_LE(fine.mismatches, coarse.mismatches) << levels;
    coarse = fine;
  }
  EXPECT_LT(coarse.depth_median, 1e-4);
  EXPECT_LT(coarse.normal_median_deg, 5e-3);
}

TEST(MeshTruth, OfASheetSeenFromBehindIsTurnedToTheEye) {
  Mesh mesh;
  mesh.vertices.position = {{-9.0, -9.0, 0.0}, {9.0, -9.0, 0.0}, {0.0, 9.0, 0.0}};
  mesh.triangles = {{0, 1, 2}};
  View view;
  view.width = view.height = 4;
  for (const double side : {-2.0, 2.0}) {
    view.camera.eye = {0.1, 0.2, side};
    view.camera.target = {0.1, 0.2, 0.0};
    for (const TruePixel& pixel : mesh_truth(mesh, view).pixels) {
      EXPECT_FALSE(pixel.edge);
      EXPECT_NEAR(angle_deg(pixel.normal_world, {0.0, 0.0, side}), 0.0, 1e-5);
    }
  }
}

}  // namespace
}  // namespace splatray::testing
