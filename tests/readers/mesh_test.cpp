/// OBJ, STL, and meshes turned into points.
#include <chrono>
#include <cmath>

#include "engine/base/srgb.h"
#include "preprocess/mesh/mesh_normals.h"
#include "preprocess/mesh/sample_mesh.h"
#include "preprocess/mesh/texture/texture.h"
#include "tests/readers/read_error.h"

namespace splatray {
namespace {

const char* const CUBE_OBJ =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

TEST(Obj, ACubeIsSampledAndItsNormalsAreSharp) {
  const TempFolder folder;
  const Input input = read_input({folder.write("cube.obj", CUBE_OBJ)}, {});
  const InputObject& cube = input.objects[0];
  EXPECT_GE(cube.points.size(), 100000U);
  EXPECT_TRUE(has_note(input, "a mesh is too coarse"));
  EXPECT_TRUE(has_note(input, "--mesh-points asks for another number"));
  EXPECT_TRUE(cube.oriented);
  EXPECT_NEAR(cube.surface_area, 6.0, 1e-6);
  for (std::size_t i = 0; i < cube.points.size(); ++i) {
    const glm::dvec3 outward = cube.points.position[i] - 0.5;
    EXPECT_NEAR(glm::dot(outward, glm::dvec3(cube.points.normal[i])), 0.5, 1e-6);
  }
}

TEST(Obj, ColoursAreThoseOfTheirRange) {
  const TempFolder folder;
  const auto first_color = [&](const char* color) {
    const std::string text = std::string("v 0 0 0 ") + color + "\nv 1 0 0\nv 0 1 0 0 0 0\nf 1 2 3\n";
    return read_input({folder.write("c.obj", text)}, keeping_meshes()).objects[0].meshes[0].vertices;
  };
  EXPECT_EQ(first_color("1 0.5 0").color.at(0), glm::vec3(1.0F, srgb_to_linear(0.5F), 0.0F));
  EXPECT_FLOAT_EQ(first_color("255 51 0").color.at(0).y, srgb_to_linear(0.2F));
  EXPECT_EQ(first_color("nan -1 inf").color.at(0).x, 0.0F);
  EXPECT_EQ(first_color("1 0.5 0").color.at(1), glm::vec3(1.0F)) << "without a colour of its own";
}

TEST(Obj, CornersHaveTheirOwnNormals) {
  const TempFolder folder;
  const std::string text =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 1\nvn 0 1 0\nf 1//1 2//1 3//1\nf 1//2 4//2 2//2\nf 1 2 4\n";
  const Mesh mesh = read_input({folder.write("n.obj", text)}, keeping_meshes()).objects[0].meshes[0];
  ASSERT_EQ(mesh.triangles.size(), 3U);
  const auto corner = [&](std::size_t triangle, int i) { return mesh.triangles[triangle][i]; };
  EXPECT_EQ(mesh.vertices.normal.at(corner(0, 0)), glm::vec3(0.0F, 0.0F, 1.0F));
  EXPECT_EQ(mesh.vertices.normal.at(corner(1, 0)), glm::vec3(0.0F, 1.0F, 0.0F));
  EXPECT_EQ(mesh.vertices.normal.at(corner(2, 0)), glm::vec3(0.0F)) << "to be found from the faces";
  EXPECT_EQ(mesh.vertices.position.at(corner(1, 2)), glm::dvec3(1.0, 0.0, 0.0));
}

TEST(Obj, WithoutFacesIsAPointSet) {
  const TempFolder folder;
  const std::string text = "v 4000000.001 0 0\nvn 0 0 2\nv 1 0 0\nvn 0 1 0\np 1 2\nl 1 2\n";
  const Points points = read_input({folder.write("p.obj", text)}, {}).objects[0].points;
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points.position[0].x, 4000000.001) << "positions are float64";
  EXPECT_EQ(points.normal.at(1), glm::vec3(0.0F, 1.0F, 0.0F));
}

/// Found by a fuzzer: VTK's reader, which was used before, took the second line for a face and read outside its arrays.
TEST(Obj, AContinuedLineKeepsItsKeyword) {
  const TempFolder folder;
  const std::string text = "v 0 0 0\no\\\\\\\nf 1/1/1 2/2/ 0 9\n";
  EXPECT_EQ(read_input({folder.write("o.obj", text)}, {}).objects[0].points.size(), 1U);
}

TEST(Obj, WhatIsNotReadIsNamed) {
  const TempFolder folder;
  const std::string text = "mtllib a.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\nf 1 2 3\n";
  EXPECT_TRUE(
      has_note(read_input({folder.write("a.obj", text)}, keeping_meshes()), "skipped 'lines', 'materials'"));
}

TEST(Obj, LinesGoOnBehindABackslash) {
  const TempFolder folder;
  const std::string text =
      "# models in C:\\models\\\nv 0 0 \\\n0\nv \\ \r\n1 \\\r\n0 0\nv 0 1 0\nv 1 1 0\nvn 0 \\\n 0 1\nf 1//1 "
      "2//1 \\\n"
      "  4//1 3//1\n";
  const Input input = read_input({folder.write("o.obj", text)}, keeping_meshes());
  EXPECT_NEAR(input.objects[0].surface_area, 1.0, 1e-6);
  EXPECT_NE(read_error(folder.write("e.obj", "v 0 0 \\\nx\n")).find("line 2: found a vertex of 2 numbers"),
            std::string::npos);
}

TEST(Stl, FloatPositionsFarAwayAreNoted) {
  const TempFolder folder;
  EXPECT_TRUE(has_note(
      read_input({folder.write(
                     "far.stl",
                     "solid\nfacet\nvertex 4000000 0 0\nvertex 4000001 0 0\nvertex 4000000 1 0\nendfacet\n")},
                 keeping_meshes()),
      "float32"));
}

std::string binary_stl(std::uint32_t declared) {
  std::string bytes(80, ' ');
  bytes += bytes_of(declared);
  for (const float v : {0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F}) {
    bytes += bytes_of(v);
  }
  return bytes + std::string(2, '\0');
}

TEST(Stl, IsReadAndItsCountIsChecked) {
  const TempFolder folder;
  const Input input = read_input({folder.write("a.STL", binary_stl(1))}, keeping_meshes());
  EXPECT_NEAR(input.objects[0].surface_area, 0.5, 1e-6);
  EXPECT_NE(read_error(folder.write("b.stl", binary_stl(2000000000))).find("found 134 bytes"),
            std::string::npos);
  read_every_prefix(folder, "t.stl", binary_stl(1));
  read_every_prefix(
      folder, "t.stl",
      "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
      "endfacet\nendsolid a\n");
}

TEST(Stl, TrianglesBehindItsCountAreRead) {
  const TempFolder folder;
  std::string bytes = binary_stl(1);
  bytes += bytes.substr(84);
  const std::uint32_t high = 0x3F800000;  // one, as float32
  bytes.replace(bytes.size() - 50 + 12 + 8, 4, bytes_of(high));
  const Input more = read_input({folder.write("a.stl", bytes)}, keeping_meshes());
  EXPECT_EQ(more.objects[0].meshes[0].triangles.size(), 2U);
  EXPECT_TRUE(has_note(more, "it says 1 triangles, and 1 more follow; all were read"));
  const Input rest = read_input({folder.write("b.stl", binary_stl(1) + "more")}, keeping_meshes());
  EXPECT_EQ(rest.objects[0].meshes[0].triangles.size(), 1U);
  EXPECT_TRUE(has_note(rest, "the 4 bytes behind its 1 triangles are no triangles"));
  bytes.back() = '\x80';
  EXPECT_TRUE(has_note(read_input({folder.write("c.stl", bytes)}, keeping_meshes()), "may be colours"));
}

TEST(Stl, WordsStandOnAnyLines) {
  const TempFolder folder;
  const std::string facet =
      "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 Vertex 0 1 0 endloop endfacet ";
  const auto triangles = [&](const std::string& text) {
    std::vector<glm::uvec3> read =
        read_input({folder.write("a.stl", text)}, keeping_meshes()).objects[0].meshes[0].triangles;
    return read.size();
  };
  EXPECT_EQ(triangles("solid one endfacet line " + facet + facet + "endsolid one endfacet line"), 2U);
  EXPECT_EQ(triangles("solid vertex of a name\n" + facet + "\nendsolid vertex of a name\n"), 1U);
  std::string long_line = "solid ";
  for (int i = 0; i < 5000; ++i) long_line += facet;
  EXPECT_EQ(triangles(long_line), 5000U);
  EXPECT_NE(
      read_error(folder.write("w.stl", "solid a\n" + facet + "\nfaces\n")).find("line 3: found 'faces'"),
      std::string::npos);
  EXPECT_NE(read_error(folder.write("n.stl", "solid " + std::string(200000, '1')))
                .find("without the end of a facet"),
            std::string::npos);
}

TEST(Obj, BrokenFilesAreErrorsAndNothingIsPrinted) {
  const TempFolder folder;
  ::testing::internal::CaptureStderr();
  read_every_prefix(folder, "cube.obj", CUBE_OBJ);
  static_cast<void>(read_error(folder.write("i.obj", "v 0 0 0\nv 1 0 0\nf 1 2 9\n")));
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(Obj, IndicesAreChecked) {
  const TempFolder folder;
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n";
  for (const char* face : {"f 1 2 999999999", "f 1//1 2//999999999 3//1", "f 1/1 2/999999999 3/1",
                           "f -9 -2 -1", "f 1//1 2//-7 3//1", "f 0 1 2", "f 1 2 x", "f 1 2 \\\n777"}) {
    EXPECT_NE(read_error(folder.write("i.obj", vertices + face + "\n")).find("line "), std::string::npos)
        << face;
  }
  EXPECT_NE(read_error(folder.write("v.obj", "v 0 0 a\n")).find("line 1: found a vertex of 2 numbers"),
            std::string::npos);
  EXPECT_EQ(read_input({folder.write("g.obj", vertices + "f -3/-1/-1 \\\n-2/1/1 3/1/1\n")}, keeping_meshes())
                .objects.size(),
            1U);
}

/// A square of two triangles in the xy plane, side 1, with a colour ramp along x.
Mesh square() {
  Mesh mesh;
  mesh.vertices.position = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {7, 7, 7}};
  mesh.vertices.color = {{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

Points sample(const Mesh& mesh, std::uint64_t count, std::uint64_t seed) {
  return sample_surface(mesh, weld_positions(mesh.vertices.position), count, seed);
}

TEST(Sampling, IsExactSeededAndInterpolates) {
  const Mesh mesh = square();
  const Points points = sample(mesh, 10007, 1);
  ASSERT_EQ(points.size(), 10007U);
  EXPECT_EQ(points.position, sample(mesh, 10007, 1).position);
  EXPECT_NE(points.position, sample(mesh, 10007, 2).position);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(points.position[i].z, 0.0);
    EXPECT_FLOAT_EQ(points.normal[i].z, 1.0F);
    EXPECT_NEAR(points.color[i].x, points.position[i].x, 1e-5);
  }
  EXPECT_EQ(sample(mesh, 0, 1).size(), 0U);
  EXPECT_EQ(sample(mesh, 1, 1).size(), 1U);
}

/// Coefficient of variation of the distances to the nearest neighbour, away from the border.
double nearest_spread(const Points& points) {
  double sum = 0.0;
  double squares = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec3 from = points.position[i];
    if (std::abs(from.x - 0.5) > 0.45 || std::abs(from.y - 0.5) > 0.45) {
      continue;
    }
    double nearest = 1.0;
    for (std::size_t j = 0; j < points.size(); ++j) {
      nearest = j == i ? nearest : std::min(nearest, glm::distance(from, points.position[j]));
    }
    sum += nearest;
    squares += nearest * nearest;
    count += 1.0;
  }
  const double mean = sum / count;
  return std::sqrt(squares / count - mean * mean) / mean;
}

TEST(Sampling, IsMuchMoreEvenThanWhiteNoise) {
  EXPECT_LT(nearest_spread(sample(square(), 4000, 3)), 0.25);  // white noise: 0.52
}

TEST(Sampling, EqualAreasGetEqualCounts) {
  const Points points = sample(square(), 10000, 5);
  int cells[16] = {};
  for (const glm::dvec3& p : points.position) {
    ++cells[static_cast<int>(p.x * 4.0) * 4 + static_cast<int>(p.y * 4.0)];
  }
  for (const int count : cells) {
    EXPECT_NEAR(count, 625, 40);
  }
}

TEST(VertexPoints, SeamsAreJoinedCreasesKeptUnusedDropped) {
  Mesh mesh;
  mesh.vertices.position = {{0, 0, 0}, {1, 0, 0},  {0, 1, 0}, {0, 0, 0},
                            {1, 0, 0}, {0, -1, 0}, {0, 0, 0}, {9, 9, 9}};
  mesh.vertices.normal.assign(8, glm::vec3(0.0F, 0.0F, 1.0F));
  mesh.vertices.normal[6] = {1.0F, 0.0F, 0.0F};
  mesh.triangles = {{0, 1, 2}, {3, 5, 4}, {6, 1, 2}};
  const Points points = vertex_points(mesh, weld_positions(mesh.vertices.position));
  EXPECT_EQ(points.size(), 5U);  // four places, one of them with two normals
}

TEST(Texture, WrapsAndFilters) {
  auto image = std::make_shared<TextureImage>();
  image->width = 2;
  image->height = 1;
  image->texels = {{0, 0, 0, 255}, {255, 255, 255, 255}};
  Texture texture;
  texture.image = image;
  EXPECT_FLOAT_EQ(texture.color({0.5F, 0.5F}).x, 0.5F);
  EXPECT_FLOAT_EQ(texture.color({0.75F, 0.5F}).x, 1.0F);
  EXPECT_FLOAT_EQ(texture.color({0.0F, 0.5F}).x, 0.5F);
  texture.wrap_s = TextureWrap::clamp;
  EXPECT_FLOAT_EQ(texture.color({-3.0F, 0.5F}).x, 0.0F);
  texture.wrap_s = TextureWrap::mirror;
  EXPECT_FLOAT_EQ(texture.color({1.25F, 0.5F}).x, 1.0F);
  EXPECT_TRUE(std::isfinite(texture.color({NAN, INFINITY}).x));
}

}  // namespace
}  // namespace splatray
