/// Sampling of meshes by what their textures show.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "preprocess/mesh/mesh_normals.h"
#include "preprocess/mesh/sample_mesh.h"
#include "preprocess/mesh/texture/texture.h"
#include "preprocess/mesh/texture/texture_detail.h"

namespace splatray {
namespace {

constexpr int EDGE = 512;
constexpr std::uint64_t SAMPLES = 20000;

/// Whether a picture of EDGE x EDGE texels has ink there: "LABEL" in a 16th of it.
bool is_ink(int x, int y) {
  static const char* const ROWS[] = {"#.....###..####..#####.#....", "#....#...#.#...#.#.....#....",
                                     "#....#...#.#...#.#.....#....", "#....#####.####..####..#....",
                                     "#....#...#.#...#.#.....#....", "#....#...#.#...#.#.....#....",
                                     "####.#...#.####..#####.####."};
  const int column = (x - 64) / 4, row = (y - 64) / 8;
  return x >= 64 && y >= 64 && column < 28 && row < 7 && ROWS[row][column] == '#';
}

/// A square of edge 1 with that picture, or with none.
Mesh labelled(bool textured) {
  Mesh mesh;
  mesh.vertices.position = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  if (!textured) return mesh;
  mesh.texcoord = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  auto image = std::make_shared<TextureImage>();
  image->width = image->height = EDGE;
  for (int i = 0; i < EDGE * EDGE; ++i)
    image->texels.emplace_back(is_ink(i % EDGE, i / EDGE) ? glm::u8vec4(0, 0, 0, 255) : glm::u8vec4(255));
  auto texture = std::make_shared<Texture>();
  texture->image = image;
  mesh.texture = texture;
  return mesh;
}

Points sampled(const Mesh& mesh) {
  return sample_surface(mesh, weld_positions(mesh.vertices.position), SAMPLES, 1);
}

/// Share of the label's texels whose nearest point is of the wrong colour.
double misread(const Points& points) {
  int wrong = 0, all = 0;
  for (int y = 56; y < 128; y += 2)
    for (int x = 56; x < 184; x += 2) {
      const glm::dvec2 place((x + 0.5) / EDGE, (y + 0.5) / EDGE);
      double least = std::numeric_limits<double>::max();
      glm::dvec2 nearest(0.0);
      for (const glm::dvec3& point : points.position) {
        const double distance = glm::distance(glm::dvec2(point), place);
        if (distance < least) nearest = glm::dvec2(point);
        least = std::min(least, distance);
      }
      ++all;
      wrong += is_ink(int(nearest.x * EDGE), int(nearest.y * EDGE)) != is_ink(x, y) ? 1 : 0;
    }
  return double(wrong) / all;
}

/// Points in a 16th of the square that has no ink.
std::size_t points_in_blank(const Points& points) {
  return static_cast<std::size_t>(std::count_if(points.position.begin(), points.position.end(),
                                                [](const auto& p) { return p.x > 0.75 && p.y > 0.75; }));
}

TEST(TextureDetail, ALabelHasThePointsToBeRead) {
  const Points plain = sampled(labelled(false)), dense = sampled(labelled(true));
  EXPECT_EQ(plain.size(), SAMPLES);
  EXPECT_EQ(dense.size(), SAMPLES);
  EXPECT_LT(misread(dense), 0.2 * misread(plain));
  EXPECT_LT(misread(dense), 0.02);
  EXPECT_NEAR(double(points_in_blank(plain)), SAMPLES / 16.0, 0.02 * SAMPLES / 16.0);
  EXPECT_GE(double(points_in_blank(dense)), 0.49 * SAMPLES / 16.0) << "half of the points are spread evenly";
}

TEST(TextureDetail, MeshesWithoutTexturesAreWholeTriangles) {
  const std::vector<SamplePiece> pieces = sample_pieces(labelled(false), {1, 0}, SAMPLES);
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(pieces[0].triangle, 1U);
  for (const SamplePiece& piece : pieces) {
    EXPECT_EQ(piece.density, 1.0);
    EXPECT_EQ(piece.corners[1], glm::dvec3(0.0, 1.0, 0.0));
  }
}

TEST(TextureDetail, NoMoreThanFourPointsToATexel) {
  const Mesh mesh = labelled(true);
  const std::uint64_t many = std::uint64_t{1} << 22;  // 16 to a texel
  for (const SamplePiece& piece : sample_pieces(mesh, {0, 1}, many)) EXPECT_EQ(piece.density, 0.5);
}

TEST(TextureDetail, VerticesDoNotShowWhatIsFinerThanTheyAre) {
  EXPECT_TRUE(is_finer_than_vertices(labelled(true)));
  EXPECT_FALSE(is_finer_than_vertices(labelled(false)));
}

}  // namespace
}  // namespace splatray
