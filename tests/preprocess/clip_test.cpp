/// Clip lines: packed outwards; on meshes no disc sticks out past an edge, and none opens a hole.
#include "engine/scene/clip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <random>

#include "engine/scene/splat.h"
#include "preprocess/build.h"
#include "preprocess/mesh/edges/mesh_edges.h"
#include "preprocess/mesh/mesh_normals.h"
#include "preprocess/mesh/sample_mesh.h"
#include "preprocess/mesh/texture/texture.h"
#include "tests/all_tests.h"
#include "tests/preprocess/discs.h"

namespace splatray {
namespace {

using glm::dvec3;
using test::Discs;

constexpr double OUTWARDS = 0.08;  // radii by which packed lines may lie further out than asked for

Mesh mesh_of(std::vector<dvec3> positions, std::vector<glm::uvec3> triangles) {
  Mesh mesh;
  mesh.vertices.position = std::move(positions);
  mesh.triangles = std::move(triangles);
  return mesh;
}

/// Corners p + x + 2 y + 4 z of a box.
Mesh box(const dvec3& size) {
  std::vector<dvec3> corners;
  for (int i = 0; i < 8; ++i) corners.push_back(size * dvec3(i & 1, i >> 1 & 1, i >> 2 & 1));
  return mesh_of(corners, {{0, 2, 1},
                           {1, 2, 3},
                           {4, 5, 6},
                           {5, 7, 6},
                           {0, 1, 4},
                           {1, 5, 4},
                           {2, 6, 3},
                           {3, 6, 7},
                           {0, 4, 2},
                           {2, 4, 6},
                           {1, 3, 5},
                           {3, 7, 5}});
}

Scene scene_of(const Mesh& mesh, std::uint64_t points, const MeshCreases& creases) {
  const std::vector<glm::uint> weld = weld_positions(mesh.vertices.position);
  Input input;
  InputObject& object = input.objects.emplace_back();
  object.points =
      points > 0 ? sample_surface(mesh, weld, points, 1, creases) : vertex_points(mesh, weld, creases);
  object.surface_area = surface_area(mesh);
  object.measured = false;
  BuildStats stats;
  return build_scene(std::move(input), {}, 1, stats);
}

/// Points of a mesh that no disc covers, of `count`.
std::size_t holes(const Mesh& mesh, const Discs& discs, std::size_t count) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit;
  std::vector<double> until;
  for (const glm::uvec3& t : mesh.triangles) {
    const auto& p = mesh.vertices.position;
    until.push_back((until.empty() ? 0.0 : until.back()) +
                    glm::length(glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x])));
  }
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto at = std::lower_bound(until.begin(), until.end(), unit(random) * until.back());
    const glm::uvec3& t = mesh.triangles[static_cast<std::size_t>(at - until.begin())];
    const dvec3 &a = mesh.vertices.position[t.x], &b = mesh.vertices.position[t.y],
                &c = mesh.vertices.position[t.z];
    const double root = std::sqrt(unit(random)), side = unit(random);
    const dvec3 place = (1.0 - root) * a + root * (1.0 - side) * b + root * side * c;
    const bool covered = discs.cover(place, glm::normalize(glm::cross(b - a, c - a)));
    if (!covered) std::cout << "a hole at " << place.x << ' ' << place.y << ' ' << place.z << '\n';
    found += covered ? 0 : 1;
  }
  return found;
}

double outside_box(const dvec3& place, const dvec3& size) {
  const dvec3 beyond = glm::max(glm::max(-place, place - size), dvec3(0.0));
  return glm::length(beyond);
}

TEST(Clip, LinesAreRoundedOutwards) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<double> unit;
  for (int i = 0; i < 20000; ++i) {
    dvec3 normal = i % 4 == 0 ? dvec3(0.0) : dvec3(gauss(random), gauss(random), gauss(random));
    if (i % 4 == 0) normal[i / 4 % 3] = 1.0;
    const double radius = std::exp2(2.0 + 16.0 * unit(random));
    const uvec4 words =
        pack_splat({dvec3(1e6) * (0.5 + unit(random)), glm::normalize(normal), radius * radius, 0});
    const Splat splat = unpack_splat(words);
    const TangentFrame frame(splat.normal);
    const double angle = 2.0 * M_PI * unit(random);
    const dvec3 dir = std::cos(angle) * frame.u + std::sin(angle) * frame.v;
    const double distance = unit(random) * std::sqrt(splat.radius_squared);
    const std::uint32_t clip = pack_clip(words, std::array{ClipEdge{dir, splat.center + distance * dir}});
    const auto lines = unpack_clip(clip, words);
    for (int turn = 0; turn < 64; ++turn) {
      const double around = 2.0 * M_PI * turn / 64.0;
      const dvec3 offset = std::sqrt(unit(random) * splat.radius_squared) *
                           (std::cos(around) * frame.u + std::sin(around) * frame.v);
      const bool kept = std::all_of(lines.begin(), lines.end(), [&](const ClipLine& line) {
        return glm::dot(line.across, offset) <= line.limit;
      });
      const double beyond = glm::dot(dir, offset) - distance;
      const bool must_stay = beyond <= 0.0, must_go = beyond > OUTWARDS * radius + 4.0;
      ASSERT_TRUE(kept || !must_stay) << "radius " << radius << ", distance " << distance;
      ASSERT_FALSE(kept && must_go) << "radius " << radius << ", beyond " << beyond;
    }
  }
}

TEST(Clip, EllipsesAreRoundedOutwards) {
  std::mt19937_64 random(6);
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<double> unit;
  for (int i = 0; i < 20000; ++i) {
    dvec3 normal = i % 4 == 0 ? dvec3(0.0) : dvec3(gauss(random), gauss(random), gauss(random));
    if (i % 4 == 0) normal[i / 4 % 3] = 1.0;
    const uvec4 words =
        pack_splat({dvec3(1e6), glm::normalize(normal), std::exp2(4.0 + 30.0 * unit(random)), 0});
    const Splat splat = unpack_splat(words);
    const TangentFrame frame(splat.normal);
    const double angle = 2.0 * M_PI * unit(random), aspect = std::exp2(8.0 * unit(random));
    const dvec3 dir = std::cos(angle) * frame.u + std::sin(angle) * frame.v;
    const std::uint32_t clip = pack_ellipse(words, dir, aspect, 0xFF008F10U);
    ASSERT_EQ(clip & 0xFFFFU, 0x8F10U) << "the first line stays";
    ASSERT_EQ(is_ellipse(clip), aspect >= LEAST_ASPECT) << aspect;
    if (!is_ellipse(clip)) continue;
    const Ellipse ellipse = unpack_ellipse(clip, words);
    const dvec3 narrow = ellipse.across - splat.normal * glm::dot(splat.normal, ellipse.across);
    const double found = std::sqrt(1.0 + ellipse.factor * glm::dot(narrow, narrow));
    ASSERT_LE(found, aspect * (1.0 + 1e-9));
    ASSERT_GE(found, aspect / 1.08);
    ASSERT_GT(std::abs(glm::dot(glm::normalize(narrow), dir)), std::cos(1.6 * M_PI / 180.0));
    const double half_width = std::sqrt(splat.radius_squared) / found;
    EXPECT_NEAR(side_of(ellipse, splat).limit / glm::length(narrow), half_width, 1e-9 * half_width);
  }
}

TEST(Clip, ACubesDiscsEndAtItsEdges) {
  const Mesh cube = box(dvec3(1.0));
  const Scene clipped = scene_of(cube, 3000, {.clip = true});
  const auto outside = [](const dvec3& place) { return outside_box(place, dvec3(1.0)); };
  EXPECT_LT(Discs(clipped).overhang(outside), OUTWARDS);
  EXPECT_EQ(holes(cube, Discs(clipped), 50000), 0U);
  EXPECT_GT(Discs(scene_of(cube, 3000, {})).overhang(outside), 0.4)
      << "whole discs stick out: the test can fail";
}

TEST(Clip, APlateThinnerThanItsDiscsKeepsItsRims) {
  const dvec3 size(1.0, 0.7, 0.002);
  const Mesh plate = box(size);
  const Scene scene = scene_of(plate, 3000, {.clip = true});
  const auto outside = [&](const dvec3& place) { return outside_box(place, size); };
  EXPECT_LT(Discs(scene).overhang(outside), 1.0) << "at a rim's ends, where a disc would need three lines";
  EXPECT_EQ(holes(plate, Discs(scene), 50000), 0U);
}

TEST(Clip, NeedlesAndSharpCornersAreCovered) {
  const Mesh needle =
      mesh_of({{0, 0, 0}, {1, 0.02, 0}, {1, -0.02, 0}, {0, 0.5, 0}, {-0.3, 0.1, 0}}, {{0, 2, 1}, {0, 3, 4}});
  const Scene scene = scene_of(needle, 2000, {.clip = true});
  EXPECT_EQ(holes(needle, Discs(scene), 50000), 0U);
  EXPECT_FALSE(scene.clip_pool.empty());
}

TEST(Clip, ACornerThatIsNotConvexOpensNoHole) {
  SPLATRAY_NIGHTLY();
  const Mesh bracket = mesh_of({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}},
                               {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}});
  const Scene scene = scene_of(bracket, 3000, {.clip = true});
  EXPECT_EQ(holes(bracket, Discs(scene), 50000), 0U);
  const auto outside = [](const dvec3& p) {
    const double from_corner = std::min(p.x - 1.0, p.y - 1.0);
    return std::max({-p.x, -p.y, p.x - 2.0, p.y - 2.0, from_corner, 0.0});
  };
  std::size_t clipped = 0;
  for (const std::uint32_t clip : scene.clip_pool) clipped += clip != CLIP_NONE ? 1 : 0;
  EXPECT_GT(clipped, 100U);
  EXPECT_LT(Discs(scene).overhang(outside), 1.0) << "discs at the corner alone stick out, into it";
}

TEST(Clip, TJunctionsAndEdgesOfThreeFacesOpenNoHole) {
  SPLATRAY_NIGHTLY();
  // The left half's edge has a vertex that the right half's has not; a third sheet stands on it.
  const Mesh mesh = mesh_of(
      {{-1, 0, 0}, {0, 0, 0}, {0, 2, 0}, {0, 1, 0}, {1, 0, 0}, {1, 2, 0}, {-1, 2, 0}, {0, 0, 1}, {0, 2, 1}},
      {{0, 1, 3}, {0, 3, 6}, {6, 3, 2}, {1, 4, 5}, {1, 5, 2}, {1, 2, 8}, {1, 8, 7}});
  const Scene scene = scene_of(mesh, 4000, {.clip = true});
  EXPECT_EQ(holes(mesh, Discs(scene), 50000), 0U);
}

TEST(Clip, WhatIsShadedSmoothlyIsNoCrease) {
  Mesh cube = box(dvec3(1.0));
  for (const dvec3& corner : cube.vertices.position)
    cube.vertices.normal.emplace_back(glm::normalize(corner - 0.5));
  EXPECT_TRUE(scene_of(cube, 2000, {.clip = true}).clip_pool.empty());
}

/// A flat grid of n x n squares.
Mesh sheet_mesh(glm::uint n) {
  Mesh mesh;
  for (glm::uint y = 0; y <= n; ++y)
    for (glm::uint x = 0; x <= n; ++x) mesh.vertices.position.emplace_back(x / double(n), y / double(n), 0.0);
  for (glm::uint y = 0; y < n; ++y) {
    for (glm::uint x = 0; x < n; ++x) {
      const glm::uint i = y * (n + 1) + x;
      mesh.triangles.push_back({i, i + 1, i + n + 2});
      mesh.triangles.push_back({i, i + n + 2, i + n + 1});
    }
  }
  return mesh;
}

TEST(Clip, VerticesOnABorderEndThere) {
  const Mesh mesh = sheet_mesh(40);
  const Scene scene = scene_of(mesh, 0, {.clip = true});
  EXPECT_LT(
      Discs(scene).overhang([](const dvec3& place) { return outside_box(place, dvec3(1.0, 1.0, 0.0)); }),
      OUTWARDS);
  EXPECT_EQ(holes(mesh, Discs(scene), 50000), 0U);
}

/// A square whose texture leaves a round piece of it, of radius 0.3.
Mesh round_label() {
  Mesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
  mesh.texcoord = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  auto image = std::make_shared<TextureImage>();
  image->width = image->height = 256;
  for (int i = 0; i < 256 * 256; ++i) {
    const double distance = std::hypot((i % 256 + 0.5) / 256.0 - 0.5, (i / 256 + 0.5) / 256.0 - 0.5);
    const double alpha = std::clamp(0.5 + 64.0 * (0.3 - distance), 0.0, 1.0);
    image->texels.emplace_back(255, 255, 255, static_cast<std::uint8_t>(std::lround(255.0 * alpha)));
  }
  auto texture = std::make_shared<Texture>();
  texture->image = image;
  texture->alpha_cutoff = 0.5F;
  mesh.texture = texture;
  return mesh;
}

TEST(Clip, AMaskLeavesARoundLabel) {
  const Mesh label = round_label();
  const auto outside = [](const dvec3& p) { return std::max(std::hypot(p.x - 0.5, p.y - 0.5) - 0.3, 0.0); };
  const Scene clipped = scene_of(label, 3000, {.clip = true});
  for (const uvec4& words : clipped.data_pool)
    EXPECT_LT(outside(clipped.root.to_world(unpack_splat(words).center)), 0.001);
  EXPECT_LT(Discs(clipped).overhang(outside), 0.35);
  EXPECT_GT(Discs(scene_of(label, 3000, {})).overhang(outside), 0.8) << "the test can fail";
  EXPECT_NEAR(static_cast<double>(clipped.data_pool.size()), 3000 * M_PI * 0.09, 60.0);
  const Discs discs(clipped);
  std::size_t missed = 0;
  for (int i = 0; i < 20000; ++i) {
    const double angle = 2.399963 * i, radius = 0.299 * std::sqrt(i / 20000.0);
    missed +=
        discs.cover({0.5 + radius * std::cos(angle), 0.5 + radius * std::sin(angle), 0.0}, {0, 0, 1}) ? 0 : 1;
  }
  EXPECT_EQ(missed, 0U);
}

TEST(Clip, AnAngleBelowTheCreasesIsNone) {
  Mesh roof = sheet_mesh(8);
  for (dvec3& place : roof.vertices.position) place.z = -std::abs(place.x - 0.5);  // turns by 90 degrees
  const auto clipped = [&](double degrees) {
    const Scene scene = scene_of(roof, 2000, {std::cos(glm::radians(degrees)), true});
    std::size_t inside = 0;
    for (std::size_t i = 0; i < scene.clip_pool.size(); ++i) {
      const dvec3 place = scene.root.to_world(unpack_splat(scene.data_pool[i]).center);
      const bool near_ridge = std::abs(place.x - 0.5) < 0.01 && std::abs(place.y - 0.5) < 0.4;
      inside += near_ridge && scene.clip_pool[i] != CLIP_NONE ? 1 : 0;
    }
    return inside;
  };
  EXPECT_GT(clipped(80.0), 20U);
  EXPECT_EQ(clipped(100.0), 0U);
}

/// A unit sphere of 2 n^2 squares, by longitude and latitude, whose radius has waves of this height, 7 around it.
Mesh wavy_sphere(glm::uint n, double waves) {
  std::vector<dvec3> places;
  std::vector<glm::uvec3> triangles;
  for (glm::uint y = 0; y <= n; ++y) {
    for (glm::uint x = 0; x < 2 * n; ++x) {
      const double down = M_PI * y / n, around = M_PI * x / n;
      const double radius = 1.0 + waves * std::sin(7.0 * down) * std::sin(7.0 * around);
      places.push_back(radius * dvec3(std::sin(down) * std::cos(around), std::sin(down) * std::sin(around),
                                      std::cos(down)));
      const glm::uint next = (x + 1) % (2 * n), row = 2 * n * y, below = row + 2 * n;
      if (y == n) continue;
      if (y > 0) triangles.push_back({row + x, below + x, row + next});
      if (y + 1 < n) triangles.push_back({row + next, below + x, below + next});
    }
  }
  for (glm::uint x = 0; x < 2 * n; ++x) places[x] = {0, 0, 1}, places[2 * n * n + x] = {0, 0, -1};
  return mesh_of(places, triangles);
}

/// Sides of triangles at edges; creases of the mesh are two each.
std::size_t sharp_edges(const Mesh& mesh, double crease_degrees = 30.0) {
  const std::vector<glm::uint> weld = weld_positions(mesh.vertices.position);
  const double cosine = std::cos(glm::radians(crease_degrees));
  const MeshEdges edges(mesh, weld, corner_normals(mesh, weld, cosine), cosine);
  std::size_t found = 0;
  for (std::uint32_t t = 0; t < edges.triangles(); ++t)
    for (std::uint32_t side = 0; side < 3; ++side) found += edges.across(t, side) == MeshEdges::NONE ? 1 : 0;
  return found;
}

/// Edges of a mesh that turn by more than 30 degrees.
std::size_t turning_edges(const Mesh& mesh) {
  std::size_t found = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t u = 0; u < t; ++u) {
      const auto &a = mesh.triangles[t], &b = mesh.triangles[u];
      const auto in_a = [&](glm::uint i) { return i == a.x || i == a.y || i == a.z; };
      if (int{in_a(b.x)} + int{in_a(b.y)} + int{in_a(b.z)} != 2) continue;
      const auto normal = [&](const glm::uvec3& c) {
        const auto& p = mesh.vertices.position;
        return glm::normalize(glm::cross(p[c.y] - p[c.x], p[c.z] - p[c.x]));
      };
      found += glm::dot(normal(a), normal(b)) < std::cos(glm::radians(30.0)) ? 1 : 0;
    }
  return found;
}

TEST(Clip, CurvedBodiesHaveNoCreasesHoweverCoarse) {
  for (const auto& [n, waves] : {std::pair{20U, 0.1}, {24U, 0.07}, {32U, 0.05}}) {
    const Mesh wavy = wavy_sphere(n, waves);
    EXPECT_GT(turning_edges(wavy), 40U) << "or there was nothing to find";
    EXPECT_EQ(sharp_edges(wavy), 0U) << n << ' ' << waves;
  }
  EXPECT_TRUE(scene_of(wavy_sphere(24, 0.07), 5000, {.clip = true}).clip_pool.empty());
}

TEST(Clip, EdgesThatStandOutAreKept) {
  Mesh cut = wavy_sphere(24, 0.005);  // with a flat below: a crease all around
  for (dvec3& place : cut.vertices.position) place.z = std::max(place.z, -0.6);
  EXPECT_GE(sharp_edges(cut), 2U * 48U * 9 / 10) << "of 48 edges, each on two triangles";
  EXPECT_EQ(sharp_edges(box(dvec3(1.0))), 24U);
}

/// Turns a line of radii and heights, from the axis to the axis, around z in `n` steps.
Mesh lathe(const std::vector<glm::dvec2>& line, glm::uint n) {
  std::vector<dvec3> places;
  std::vector<glm::uvec3> triangles;
  for (const glm::dvec2& at : line)
    for (glm::uint i = 0; i < n; ++i)
      places.emplace_back(at.x * std::cos(2.0 * M_PI * i / n), at.x * std::sin(2.0 * M_PI * i / n), at.y);
  for (glm::uint ring = 0; ring + 1 < line.size(); ++ring)
    for (glm::uint i = 0; i < n; ++i) {
      const glm::uint a = ring * n + i, b = ring * n + (i + 1) % n;
      if (line[ring].x > 0.0) triangles.push_back({a, b, a + n});
      if (line[ring + 1].x > 0.0) triangles.push_back({b, b + n, a + n});
    }
  return mesh_of(places, triangles);
}

/// A cone whose side leans by this angle, 0 a cylinder's, and ends below at a chamfer that turns by `chamfer`; degrees.
Mesh chamfered(double lean, double chamfer, glm::uint n) {
  const double down = glm::radians(lean - chamfer);
  const glm::dvec2 end(1.0 + 0.3 * std::sin(down), -0.3 * std::cos(down));
  return lathe({{0.0, end.y}, end, {1.0, 0.0}, {1.0 - 2.0 * std::tan(glm::radians(lean)), 2.0}, {0.0, 2.0}},
               n);
}

TEST(Clip, ChamfersAreCreasesHoweverCoarseTheCylinder) {
  for (const glm::uint n : {16U, 24U, 48U})
    for (const double lean : {0.0, 15.0})
      for (const double chamfer : {33.0, 40.0})
        EXPECT_EQ(sharp_edges(chamfered(lean, chamfer, n)), 2U * 3U * n)
            << n << ' ' << lean << ' ' << chamfer;
  for (const glm::uint n : {24U, 48U}) EXPECT_EQ(sharp_edges(chamfered(0.0, 25.0, n), 20.0), 2U * 3U * n);
  EXPECT_GE(sharp_edges(chamfered(0.0, 45.0, 4)), 2U * 3U * 4U) << "a box's";
}

TEST(Clip, AToolsRoundEndIsNoCreaseAndItsChamferIs) {
  std::vector<glm::dvec2> line{{0.0, 0.0}, {0.6, 0.0}, {0.6, 2.0}, {1.0, 2.6}};  // turns by 34 degrees
  for (int step = 0; step < 9; ++step) {
    const double angle = step * M_PI / 18.0;
    line.emplace_back(std::cos(angle), 4.0 + std::sin(angle));
  }
  line.emplace_back(0.0, 5.0);
  for (const glm::uint n : {16U, 32U}) EXPECT_EQ(sharp_edges(lathe(line, n)), 2U * 3U * n);
}

TEST(Clip, EdgesOfSmallPartsAreKeptBesideALargeOneWithout) {
  Mesh both = wavy_sphere(24, 0.0);
  const auto first = static_cast<glm::uint>(both.vertices.size());
  const Mesh small = box(dvec3(0.02));
  for (const dvec3& corner : small.vertices.position) both.vertices.position.push_back(corner + 2.0);
  for (const glm::uvec3& t : small.triangles) both.triangles.push_back(t + first);
  EXPECT_EQ(sharp_edges(both), 24U);
}

}  // namespace
}  // namespace splatray
