/// Coarse meshes that are shaded smoothly: their points, rims and clip lines are those of the smooth surface.
#include "preprocess/mesh/smooth_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>

#include "engine/scene/splat.h"
#include "preprocess/build.h"
#include "preprocess/mesh/mesh_points.h"
#include "preprocess/mesh/refined_mesh.h"
#include "preprocess/mesh/sample_mesh.h"
#include "tests/preprocess/discs.h"
#include "tests/preprocess/sampled_scene.h"

namespace splatray {
namespace {

using glm::dvec3;
using test::Discs;

constexpr glm::uint SIDES = 18;

dvec3 around(double turns) { return {std::cos(2.0 * M_PI * turns), 0.0, std::sin(2.0 * M_PI * turns)}; }

/// A tube of flat sides around the y axis, of radius 1 and height 2, with normals of a round one; with lids of their own
/// normals or open.
Mesh tube(bool lids) {
  Mesh mesh;
  const auto ring = [&](bool of_lids) {
    for (glm::uint side = 0; side < SIDES; ++side)
      for (const double height : {-1.0, 1.0}) {
        const dvec3 out = around(side / double(SIDES));
        mesh.vertices.position.push_back(out + dvec3(0.0, height, 0.0));
        mesh.vertices.normal.emplace_back(of_lids ? dvec3(0.0, height, 0.0) : out);
      }
  };
  ring(false);
  if (lids) ring(true);
  for (glm::uint side = 0; side < SIDES; ++side) {
    const glm::uint low = 2 * side, next = 2 * ((side + 1) % SIDES), lid = 2 * SIDES;
    mesh.triangles.emplace_back(low, low + 1, next);
    mesh.triangles.emplace_back(low + 1, next + 1, next);
    if (!lids || side == 0 || side + 1 == SIDES) continue;
    mesh.triangles.emplace_back(lid, lid + low, lid + next);
    mesh.triangles.emplace_back(lid + 1, lid + next + 1, lid + low + 1);
  }
  return mesh;
}

/// Places of the round tube that no disc covers, of 4000 on its side, half of them at its rims, and 4000 on its lids.
std::size_t holes(const Discs& discs, bool lids) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit;
  std::size_t open = 0;
  for (int i = 0; i < 4000; ++i) {
    const dvec3 out = around(unit(random));
    const double share = unit(random), height = i % 2 == 0 ? 2.0 * share - 1.0 : 1.0 - 0.02 * share;
    open += discs.cover(0.9999 * out + dvec3(0.0, height, 0.0), out) ? 0 : 1;
    if (lids)
      open += discs.cover(0.998 * std::sqrt(share) * out + dvec3(0.0, 1.0, 0.0), {0.0, 1.0, 0.0}) ? 0 : 1;
  }
  return open;
}

TEST(SmoothSurface, RimsOfACoarseTubeAreRound) {
  const auto beyond = [](const dvec3& place) {
    return std::max({std::hypot(place.x, place.z) - 1.0, std::abs(place.y) - 1.0, 0.0});
  };
  for (const bool lids : {false, true}) {
    const Scene scene = test::sampled_scene(tube(lids), 6000);
    EXPECT_EQ(holes(Discs(scene), lids), 0U) << (lids ? "with lids" : "open");
    EXPECT_LT(Discs(scene).overhang(beyond), 0.25) << (lids ? "with lids" : "open");
  }
}

TEST(SmoothSurface, DiscsOfACoarseDrawingLieInItsFacets) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.position.emplace_back(i & 1, i >> 1 & 1, i >> 2 & 1);
    mesh.vertices.normal.emplace_back(mesh.vertices.position.back() - 0.5);
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  const Scene scene = test::sampled_scene(mesh, 3000);
  for (std::size_t i = 0; i < scene.data_pool.size(); ++i) {
    const Splat splat = unpack_splat(scene.data_pool[i]);
    const dvec3 lean = unpack_lean(scene.field_pool[i], splat.normal);
    const dvec3 place = scene.root.to_world(splat.center) - 0.5;
    dvec3 face(0.0);
    for (glm::length_t axis = 0; axis < 3; ++axis)
      if (std::abs(place[axis]) > 0.4999) face[axis] = std::copysign(1.0, place[axis]);
    if (glm::length(face) > 1.0) continue;  // on an edge
    EXPECT_GT(glm::dot(splat.normal, glm::normalize(face)), std::cos(4.0 * M_PI / 180.0)) << "discs lean";
    const dvec3 seen = glm::normalize(splat.normal + lean);
    const dvec3 wanted = glm::normalize(place);
    const double most = std::max(glm::dot(wanted, glm::normalize(face)), std::cos(20.0 * M_PI / 180.0));
    EXPECT_NEAR(glm::dot(seen, glm::normalize(face)), most, 0.005) << "what light sees";
  }
  EXPECT_FALSE(any_leans(test::sampled_scene(mesh, 300).field_pool)) << "facets of few discs";
}

TEST(SmoothSurface, BothTrianglesAtAnEdgeBendItAlike) {
  const Mesh mesh = tube(true);
  const std::vector<glm::uint> weld = weld_positions(mesh.vertices.position);
  const std::vector<glm::vec3> corners = corner_normals(mesh, weld);
  const MeshEdges edges(mesh, weld, corners, DEFAULT_CREASE_COSINE);
  const SmoothSurface surface(mesh, weld, corners, edges);
  int bent = 0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::uint32_t side = 0; side < 3; ++side) {
      const std::uint32_t beside = edges.beside(t, side);
      ASSERT_NE(beside, MeshEdges::NONE);
      const dvec3 bow = surface.triangle(t).bow[side];
      bent += glm::length(bow) > 0.01 ? 1 : 0;
      const auto& others = surface.triangle(beside).bow;
      EXPECT_TRUE(
          std::any_of(others.begin(), others.end(), [&](const dvec3& other) { return other == bow; }));
    }
  EXPECT_EQ(bent, 6 * int(SIDES)) << "diagonals and rims, each twice, are bent";
}

TEST(SmoothSurface, BordersSharedWithAnotherMeshStayStraight) {
  const auto highest_at_rim = [](bool with_lid) {
    Input input;
    input.objects.emplace_back().meshes.push_back(tube(false));
    if (with_lid) {
      Mesh lid;
      for (glm::uint side = 0; side < SIDES; ++side)
        lid.vertices.position.push_back(around(side / double(SIDES)) + dvec3(0.0, 1.0, 0.0));
      for (glm::uint side = 1; side + 1 < SIDES; ++side) lid.triangles.emplace_back(0, side, side + 1);
      input.objects.emplace_back().meshes.push_back(std::move(lid));
    }
    ReadOptions options;
    options.samples = 20000;
    points_from_meshes(input, options);
    double highest = 0.0;
    for (const dvec3& place : input.objects[0].points.position) {
      const double turns = std::atan2(place.z, place.x) / (2.0 * M_PI) * SIDES;
      const double along_chord = std::cos(2.0 * M_PI / SIDES * (turns - std::floor(turns) - 0.5));
      if (place.y > 0.99)
        highest = std::max(highest, std::hypot(place.x, place.z) - std::cos(M_PI / SIDES) / along_chord);
    }
    return highest;
  };
  EXPECT_LT(highest_at_rim(true), 0.001) << "or the lid, which is flat, does not meet the rim";
  EXPECT_GT(highest_at_rim(false), 0.01);
}

/// A ball of 14 x 28 facets with normals of a round one, whose vertices lie off it by up to `off` along their normals.
Mesh coarse_ball(double off) {
  constexpr glm::uint ROWS = 14, COLUMNS = 28;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Mesh mesh;
  for (glm::uint row = 0; row <= ROWS; ++row)
    for (glm::uint column = 0; column < COLUMNS; ++column) {
      const double down = M_PI * row / ROWS;
      const dvec3 out = std::sin(down) * around(column / double(COLUMNS)) + dvec3(0.0, std::cos(down), 0.0);
      const bool pole = row == 0 || row == ROWS;
      mesh.vertices.position.push_back(pole ? dvec3(0.0, row == 0 ? 1.0 : -1.0, 0.0)
                                            : (1.0 + off * unit(random)) * out);
      mesh.vertices.normal.emplace_back(out);
      const glm::uint next = (column + 1) % COLUMNS, begin = COLUMNS * row;
      if (row == ROWS) continue;
      if (row > 0) mesh.triangles.emplace_back(begin + column, begin + next, begin + COLUMNS + column);
      if (row + 1 < ROWS)
        mesh.triangles.emplace_back(begin + next, begin + COLUMNS + next, begin + COLUMNS + column);
    }
  return mesh;
}

/// A box of 2 x 2 x 2 with bevels of two facets, 0.1 wide, and with normals that are means across these.
Mesh bevelled_box() {
  Mesh mesh;
  const std::array<double, 4> steps{-1.0, -0.9, 0.9, 1.0};
  for (glm::length_t axis = 0; axis < 3; ++axis)
    for (const double face : {-1.0, 1.0})
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
          const auto first = static_cast<glm::uint>(mesh.vertices.position.size());
          for (const auto& [di, dj] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
            dvec3 place;
            place[axis] = face;
            place[(axis + 1) % 3] = steps[i + static_cast<std::size_t>(di)];
            place[(axis + 2) % 3] = steps[j + static_cast<std::size_t>(dj)];
            const dvec3 within = glm::clamp(place, -0.9, 0.9);
            mesh.vertices.position.push_back(within + 0.1 * glm::normalize(place - within));
          }
          mesh.triangles.emplace_back(first, first + 1, first + 2);
          mesh.triangles.emplace_back(first, first + 2, first + 3);
          if (face < 0.0)
            for (std::size_t t = mesh.triangles.size() - 2; t < mesh.triangles.size(); ++t)
              std::swap(mesh.triangles[t].y, mesh.triangles[t].z);
        }
  mesh.vertices.normal = vertex_normals(mesh, weld_positions(mesh.vertices.position));
  return mesh;
}

/// The farthest that the surface lies off a mesh's facets.
double most_bent(const Mesh& mesh) {
  const std::vector<glm::uint> weld = weld_positions(mesh.vertices.position);
  const std::vector<glm::vec3> corners = corner_normals(mesh, weld);
  const MeshEdges edges(mesh, weld, corners, DEFAULT_CREASE_COSINE);
  const SmoothSurface surface(mesh, weld, corners, edges);
  double most = 0.0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (const dvec3& bow : surface.triangle(t).bow) most = std::max(most, 0.125 * glm::length(bow));
  return most;
}

TEST(SmoothSurface, OnlyVerticesOnACurveBendFacets) {
  EXPECT_NEAR(most_bent(coarse_ball(0.0)), 1.0 - std::cos(M_PI / 14.0 * std::sqrt(0.5)), 0.003);
  EXPECT_EQ(most_bent(coarse_ball(0.05)), 0.0) << "as scans' vertices do, these lie beside the surface";
  Mesh bare = coarse_ball(0.0);
  bare.vertices.normal.clear();
  EXPECT_EQ(most_bent(bare), 0.0) << "a file without normals means its facets";
}

TEST(SmoothSurface, FlatsBetweenBevelsStayFlat) {
  const Mesh box = bevelled_box();
  const std::vector<glm::uint> weld = weld_positions(box.vertices.position);
  const std::vector<glm::vec3> corners = corner_normals(box, weld);
  const MeshEdges edges(box, weld, corners, DEFAULT_CREASE_COSINE);
  const SmoothSurface surface(box, weld, corners, edges);
  int leaning = 0;
  for (std::uint32_t t = 0; t < box.triangles.size(); ++t) {
    const SmoothTriangle smooth = surface.triangle(t);
    for (std::size_t i = 0; i < 3; ++i) {
      const dvec3 along = smooth.corners[(i + 1) % 3] - smooth.corners[i];
      if (glm::length(along) < 1.0) continue;
      leaning += std::abs(glm::dot(along, dvec3(corners[3 * t + i]))) > 0.1 ? 1 : 0;
      EXPECT_EQ(smooth.bow[i], dvec3(0.0)) << "triangle " << t;
    }
  }
  EXPECT_GT(leaning, 12) << "or nothing asks for arches";
}

TEST(SmoothSurface, PartsOfARefinedMeshJoin) {
  const Mesh mesh = tube(true);
  const std::vector<glm::uint> weld = weld_positions(mesh.vertices.position);
  const std::vector<glm::vec3> corners = corner_normals(mesh, weld);
  const MeshEdges edges(mesh, weld, corners, DEFAULT_CREASE_COSINE);
  const RefinedMesh refined(mesh, edges, SmoothSurface(mesh, weld, corners, edges), 1e-4);
  ASSERT_GT(refined.mesh().triangles.size(), 4 * mesh.triangles.size());
  const MeshEdges parts = refined.edges(weld_positions(refined.mesh().vertices.position));
  double rims = 0.0;
  for (std::uint32_t part = 0; part < parts.triangles(); ++part)
    for (std::uint32_t side = 0; side < 3; ++side) {
      EXPECT_NE(parts.beside(part, side), part) << "closed, as the mesh is";
      if (parts.across(part, side) != MeshEdges::NONE) continue;
      const glm::uvec3& t = refined.mesh().triangles[part];
      const auto from = static_cast<glm::length_t>(side);
      const auto& places = refined.mesh().vertices.position;
      rims += glm::distance(places[t[from]], places[t[(from + 1) % 3]]);
    }
  EXPECT_NEAR(rims / (8.0 * M_PI), 1.0, 1e-3) << "two round rims, from both sides";
  for (const double share : {0.1, 0.4, 0.7}) {
    const dvec3 weights(share, 0.5 * (1.0 - share), 0.5 * (1.0 - share));
    const std::uint32_t part = refined.part_at(3, weights);
    EXPECT_EQ(refined.triangle_of(part), 3U);
    const dvec3 middle = refined.weights_of(part, dvec3(1.0 / 3.0));
    EXPECT_LT(glm::distance(middle, weights), 0.5);
  }
}

}  // namespace
}  // namespace splatray
