// Where a ball turns away from the light: coarse meshes that are shaded smoothly are lit as the smooth surface is.
#include <gtest/gtest.h>

#include "preprocess/mesh/sample_mesh.h"
#include "tests/light/lit.h"

namespace splatray::testing {
namespace {

/// A unit ball of `rings` by `sides` facets, with its own normals or without.
Mesh coarse_ball(int rings, int sides, bool smooth) {
  Mesh mesh;
  for (int ring = 0; ring <= rings; ++ring)
    for (int side = 0; side < sides; ++side) {
      const double polar = pi * ring / rings, around = 2.0 * pi * side / sides;
      const double radius = ring < rings ? std::sin(polar) : 0.0;  // one pole to the last bit
      const dvec3 place(radius * std::cos(around), std::cos(polar), radius * std::sin(around));
      mesh.vertices.position.push_back(place);
      if (smooth) mesh.vertices.normal.emplace_back(place);
    }
  const auto vertex = [sides](int ring, int side) {
    return static_cast<glm::uint>(ring * sides + side % sides);
  };
  for (int ring = 0; ring < rings; ++ring)
    for (int side = 0; side < sides; ++side) {
      if (ring > 0)
        mesh.triangles.emplace_back(vertex(ring, side), vertex(ring, side + 1), vertex(ring + 1, side));
      if (ring + 1 < rings)
        mesh.triangles.emplace_back(vertex(ring, side + 1), vertex(ring + 1, side + 1),
                                    vertex(ring + 1, side));
    }
  return mesh;
}

Points points_on(const Mesh& mesh) {
  return sample_surface(mesh, weld_positions(mesh.vertices.position), 20000, 1, {.clip = true});
}

TEST(CoarseBall, PointsLieOnTheSmoothSurface) {
  for (const dvec3& place : points_on(coarse_ball(14, 28, true)).position)
    EXPECT_NEAR(glm::length(place), 1.0, 1e-3);  // chords lie up to 0.0126 below
  double least = 1.0;
  for (const dvec3& place : points_on(coarse_ball(4, 6, true)).position)
    least = std::min(least, glm::length(place));
  EXPECT_LT(least, 0.85) << "normals that turn by 60 degrees are of an angular body";
}

/// A tube between two discs: its side is smooth around, its rims are creases.
TEST(CoarseTube, RimsStayWhereTheyAre) {
  Mesh tube;
  constexpr int SIDES = 24;
  for (int side = 0; side < SIDES; ++side)
    for (const double height : {-1.0, 1.0})
      tube.vertices.position.emplace_back(std::cos(2.0 * pi * side / SIDES), height,
                                          std::sin(2.0 * pi * side / SIDES));
  for (glm::uint side = 0; side < SIDES; ++side) {
    const glm::uint low = 2 * side, next = 2 * ((side + 1) % SIDES);
    tube.triangles.emplace_back(low, low + 1, next);
    tube.triangles.emplace_back(low + 1, next + 1, next);
    if (side > 0 && side + 1 < SIDES) {
      tube.triangles.emplace_back(0, low, next);
      tube.triangles.emplace_back(1, next + 1, low + 1);
    }
  }
  const Points points = points_on(tube);
  double widest = 0.0;
  for (const dvec3& place : points.position) {
    const double chord = std::cos(pi / SIDES), around = std::hypot(place.x, place.z);
    EXPECT_LE(std::abs(place.y), 1.0 + 1e-12) << "caps are flat";
    EXPECT_LE(around, 1.0 + 1e-3);
    if (std::abs(place.y) < 0.9) widest = std::max(widest, around);
    if (std::abs(place.y) > 0.999 && std::abs(place.y) < 1.0 - 1e-9) {
      EXPECT_GE(around, chord - 1e-3);
    }
  }
  EXPECT_GT(widest, 0.999);
}

class Terminator : public Lit {
 protected:
  /// The least and the largest of what a ball's pixels show, of what they should, where the sun stands at least 3 degrees high.
  std::pair<double, double> range_of(const Mesh& mesh) {
    const Points points = points_on(mesh);
    OrientedPoints oriented;
    oriented.position = points.position;
    oriented.normal.assign(points.normal.begin(), points.normal.end());
    const dvec3 sun(glm::normalize(dvec3(1.0, 0.3, 0.1)));
    show(scene_of({{oriented, grey(1.0F)}}), constant(0.0F), {{LIGHT_DIRECTIONAL, sun, vec3(float(pi))}});
    constexpr std::uint32_t SIDE = 128;
    Settings settings = lit(16);
    settings.max_bounces = 0;
    const Image image =
        picture({dvec3(0.0, 0.0, 4.0), dvec3(0.0), dvec3(0.0, 1.0, 0.0), 0.0, 2.2}, settings, SIDE);
    std::pair<double, double> range{1e30, 0.0};
    for (std::uint32_t i = 0; i < SIDE * SIDE; ++i) {
      const double x = 1.1 * (2.0 * (i % SIDE + 0.5) / SIDE - 1.0),
                   y = 1.1 * (1.0 - 2.0 * (i / SIDE + 0.5) / SIDE);
      const double squared = 1.0 - x * x - y * y;
      if (squared < 0.05) continue;
      const double truth = glm::dot(dvec3(x, y, std::sqrt(squared)), sun);
      if (truth < std::sin(3.0 * pi / 180.0)) continue;
      const double share = double(image.rgba[i].x) / truth;
      range = {std::min(range.first, share), std::max(range.second, share)};
    }
    return range;
  }
};

TEST_F(Terminator, OfACoarseBall) {
  const auto [least, most] = range_of(coarse_ball(14, 28, true));
  EXPECT_GE(least, 0.98);
  EXPECT_LE(most, 1.02);
}

TEST_F(Terminator, OfAFineBall) {
  const auto [least, most] = range_of(coarse_ball(60, 120, true));
  EXPECT_GE(least, 0.98);
  EXPECT_LE(most, 1.02);
}

}  // namespace
}  // namespace splatray::testing
