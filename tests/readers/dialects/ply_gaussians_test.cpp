/// Captures of 3D Gaussians in PLY files become points of their surface; those of other formats are refused.
#include <bit>
#include <cmath>
#include <cstring>

#include "preprocess/build.h"
#include "preprocess/read/scan/gaussian_cloud.h"
#include "tests/readers/read_error.h"

namespace splatray {
namespace {

/// A Gaussian alone shows two on each side, the first in its middle.
constexpr std::size_t POINTS_OF_ONE = 4;

std::string plain_head(int count, const std::string& more = "") {
  std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(count) + "\n";
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "f_dc_0", "f_dc_1", "f_dc_2", "opacity",
                           "scale_0", "scale_1", "scale_2", "rot_0", "rot_1", "rot_2", "rot_3"})
    text += std::string("property float ") + name + "\n";
  return text + more + "end_header\n";
}

/// A row: centre, no normal, colour 0.75 0.5 0.25, logit of opacity, deviations 0.1 0.4 0.2 and a quaternion.
std::string plain_row(const std::string& centre, const std::string& logit, const std::string& quaternion) {
  const double of_quarter = 0.25 / 0.28209479177387814;
  return centre + " 0 0 0 " + std::to_string(of_quarter) + " 0 " + std::to_string(-of_quarter) + " " + logit +
         " " + std::to_string(std::log(0.1)) + " " + std::to_string(std::log(0.4)) + " " +
         std::to_string(std::log(0.2)) + " " + quaternion + "\n";
}

void expect_near(const glm::dvec3& found, const glm::dvec3& expected, double within) {
  EXPECT_LT(glm::distance(found, expected), within) << found.x << ' ' << found.y << ' ' << found.z;
}

/// The same up to its sign.
void expect_axis(const glm::dvec3& found, const glm::dvec3& expected, double within) {
  expect_near(glm::dot(found, expected) < 0.0 ? -found : found, expected, within);
}

Gaussian round_one(const glm::dvec3& center, double opacity, const glm::dvec3& color) {
  return {center, glm::dvec3(0.2), glm::dquat(1, 0, 0, 0), opacity, color};
}

TEST(Gaussians, ARayLosesLightInEachAndBlendsTheirColours) {
  const glm::dvec3 red(1, 0, 0), green(0, 1, 0), blue(0, 0, 1);
  const GaussianCloud cloud({round_one({0.1, 0, 0}, 0.4, red), round_one({0, 0, 0}, 0.5, green),
                             round_one({-0.1, 0, 0}, 1.0, blue), round_one({0, 9, 0}, 1.0, red)});
  GaussianCloud::Scratch scratch;
  const auto sight = cloud.look({-0.1, 0, 0}, {1, 0, 0}, scratch);
  ASSERT_TRUE(sight);
  expect_near(sight->surface_world, {0, 0, 0}, 1e-9);
  EXPECT_NEAR(sight->share_left, 0.6 * 0.5, 1e-9) << "before the blue one";
  expect_near(sight->color, glm::dvec3(0.4, 0.6 * 0.5, 0.3 * 0.99) / (0.4 + 0.3 + 0.3 * 0.99), 1e-9);
  const auto behind = cloud.look({-0.1, 0, 0}, {-1, 0, 0}, scratch);
  ASSERT_TRUE(behind);
  expect_near(behind->surface_world, {-0.1, 0, 0}, 1e-9);
  EXPECT_EQ(behind->share_left, 1.0);
  const double aside = std::sqrt(2.0 * std::log(2.0)) * 0.2;  // where an opaque one is half opaque
  EXPECT_TRUE(cloud.look({0, 9 + 0.99 * aside, 0}, {1, 0, 0}, scratch));
  EXPECT_FALSE(cloud.look({0, 9 + 1.01 * aside, 0}, {1, 0, 0}, scratch));
  const auto outward = cloud.outward({0.3, 9, 0});
  ASSERT_TRUE(outward);
  expect_near(*outward, {1, 0, 0}, 1e-9);
  EXPECT_FALSE(cloud.outward({0, 100, 0}));
}

TEST(Gaussians, ArePointsWhereTheyHideHalf) {
  const TempFolder folder;
  const std::string rows = plain_row("1 2 3", "40", "1 0 0 0") + plain_row("14 5 6", "40", "2 0 0 2") +
                           plain_row("70 8 9", "-0.01", "1 0 0 0") + plain_row("7 8 9", "nan", "1 0 0 0") +
                           plain_row("7 8 9", "40", "0 0 0 0") + plain_row("27 8 9", "1.0986123", "1 0 0 0");
  const Input input = read_input({folder.write("a.ply", plain_head(6) + rows)}, {});
  const Points& points = input.objects.at(0).points;
  ASSERT_EQ(points.size(), 3 * POINTS_OF_ONE) << "one hides less than half";
  expect_near(points.position[0], {1, 2, 3}, 1e-6);
  expect_near(points.normal[0], {1, 0, 0}, 1e-5);  // across the least deviation
  EXPECT_NEAR(points.position[1].x, 1.0, 0.05);
  expect_near(points.position[2], {1, 2, 3}, 1e-6);
  expect_near(points.normal[2], {-1, 0, 0}, 1e-5);  // its other side
  expect_near(points.position[4], {14, 5, 6}, 1e-6);
  expect_axis(points.normal[4], {0, 1, 0}, 1e-5);  // turned by 90 degrees about z
  expect_near(points.position[8], {27, 8, 9}, 1e-6);
  EXPECT_TRUE(points.radius.empty());
  EXPECT_NEAR(points.color.at(0).x, 0.5225, 1e-3);  // 0.75, 0.5 and 0.25 of sRGB
  EXPECT_NEAR(points.color[0].y, 0.2140, 1e-3);
  EXPECT_NEAR(points.color[0].z, 0.0509, 1e-3);
  EXPECT_EQ(input.up, glm::dvec3(0, -1, 0));
  EXPECT_TRUE(has_note(input, "6 3D Gaussians; 12 points"));
  EXPECT_TRUE(has_note(input, "2 are no Gaussians"));
}

std::string words_of(std::initializer_list<std::uint32_t> words) {
  std::string bytes(4 * words.size(), '\0');
  std::memcpy(bytes.data(), words.begin(), bytes.size());
  return bytes;
}

std::string packed_file(int chunks, int count, const std::string& rows) {
  std::string text = "ply\nformat binary_little_endian 1.0\nelement chunk " + std::to_string(chunks) + "\n";
  for (const char* name : {"min_x", "min_y", "min_z", "max_x", "max_y", "max_z", "min_scale_x", "min_scale_y",
                           "min_scale_z", "max_scale_x", "max_scale_y", "max_scale_z"})
    text += std::string("property float ") + name + "\n";
  text += "element vertex " + std::to_string(count) + "\n";
  for (const char* name : {"packed_position", "packed_rotation", "packed_scale", "packed_color"})
    text += std::string("property uint ") + name + "\n";
  text += "end_header\n";
  for (int chunk = 0; chunk < chunks; ++chunk)
    for (const float value :
         {0.0F, 1000.0F, -100.0F, 100.0F, 2000.0F, 100.0F, -3.0F, -3.0F, -3.0F, 0.0F, 0.0F, 0.0F})
      text += words_of({std::bit_cast<std::uint32_t>(value == 100.0F && chunk == 1 ? 200.0F : value)});
  return text + rows;
}

TEST(Gaussians, PackedOnesLieBetweenTheirChunksEnds) {
  const TempFolder folder;
  // A turn by 90 degrees about z: w and z are 1/sqrt(2), w is left out (number 0); x and y are in the middle of 10 bits.
  const std::uint32_t turned = 0U << 30 | 512U << 20 | 512U << 10 | 1023U;
  // w, x, y, z = 0, 0, 0, 1: z is left out (number 3).
  const std::uint32_t about_z = 3U << 30 | 512U << 20 | 512U << 10 | 512U;
  const std::uint32_t scale = 0U << 21 | 1023U << 11 | 1024U;
  const std::uint32_t color = 255U << 24 | 0U << 16 | 128U << 8 | 255U;
  std::string rows = words_of({2047U << 21, turned, scale, color}) + words_of({2047U, about_z, scale, color});
  for (int i = 2; i < 257; ++i) rows += words_of({2047U << 21 | 1023U << 11, turned, scale, color});
  const Input input = read_input({folder.write("a.ply", packed_file(2, 257, rows))}, {});
  const Points& points = input.objects.at(0).points;
  ASSERT_EQ(points.size(), 257 * POINTS_OF_ONE);
  expect_near(points.position[0], {100, 1000, -100}, 1e-6);
  expect_near(points.position[POINTS_OF_ONE], {0, 1000, 100}, 1e-6);
  expect_near(points.position[256 * POINTS_OF_ONE], {200, 2000, -100}, 1e-6);  // of the second chunk
  expect_axis(points.normal[0], {0, 1, 0}, 0.01);
  expect_axis(points.normal[POINTS_OF_ONE], {1, 0, 0}, 0.01);
  const glm::dvec3 off = points.position[1] - points.position[0];  // along its second and third axis
  EXPECT_LT(std::hypot(off.x / std::exp(0.0), off.z / std::exp(3.0 * (1024.0 / 2047.0 - 1.0))), 0.85);
  EXPECT_GT(std::abs(off.x), std::abs(off.z)) << "the second is the longest";
  EXPECT_EQ(points.color.at(0).x, 1.0F);
  EXPECT_EQ(points.color[0].y, 0.0F);
  EXPECT_NEAR(points.color[0].z, 0.2159, 1e-3);
}

/// A sheet of 20 x 20 across x, and one that hides two fifths before it.
TEST(Gaussians, ASheetHasTwoSidesAndNothingStandsWhereAFaintOneFloats) {
  const TempFolder folder;
  std::string rows = plain_row("0.3 5 3", "-0.405465", "1 0 0 0");
  for (int i = 0; i < 400; ++i)
    rows += plain_row("0 " + std::to_string(0.5 * (i % 20)) + " " + std::to_string(0.3 * (i / 20)), "40",
                      "1 0 0 0");
  const Points points = read_input({folder.write("a.ply", plain_head(401) + rows)}, {}).objects.at(0).points;
  std::size_t seen_from_front = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(points.position[i].x, 0.0, 0.15) << "none where the floating one is";
    const bool at_rim = points.position[i].y < 1.0 || points.position[i].y > 8.5 ||
                        points.position[i].z < 0.6 || points.position[i].z > 5.1;
    EXPECT_TRUE(at_rim || std::abs(points.normal[i].x) > 0.8F);
    seen_from_front += points.normal[i].x > 0.0F ? 1 : 0;
  }
  EXPECT_GT(seen_from_front, points.size() / 3);
  EXPECT_LT(seen_from_front, 2 * points.size() / 3);
}

TEST(Gaussians, SkiesAreLeftOut) {
  const TempFolder folder;
  const auto row = [](const std::string& centre, double first, double second, double third) {
    return centre + " 0 0 0 0 0 0 40 " + std::to_string(std::log(first)) + " " +
           std::to_string(std::log(second)) + " " + std::to_string(std::log(third)) + " 1 0 0 0\n";
  };
  const std::string rows = row("0 0 0", 0.1, 0.5, 0.2) + row("3 4 0", 0.1, 0.5, 0.2) +
                           row("0 0 1", 0.1, 1e9, 1e8) + row("0 0 2", 1e-3, 1e60, 1e60);
  const Input input = read_input({folder.write("a.ply", plain_head(4) + rows)}, {});
  EXPECT_EQ(input.objects.at(0).points.size(), 2 * POINTS_OF_ONE);
  EXPECT_TRUE(has_note(input, "2 are wider than all lie apart"));
}

TEST(Gaussians, FlatOnesHaveTwoScales) {
  const TempFolder folder;
  std::string text = plain_head(1) + plain_row("1 2 3", "40", "1 0 0 0");
  text.erase(text.find("property float scale_2\n"), 23);
  const std::string third = std::to_string(std::log(0.2)) + " ";
  text.erase(text.find(third), third.size());
  const Points points = read_input({folder.write("a.ply", text)}, {}).objects.at(0).points;
  ASSERT_EQ(points.size(), POINTS_OF_ONE);
  expect_near(points.position[0], {1, 2, 3}, 1e-6);
  expect_axis(points.normal[0], {0, 0, 1}, 1e-4);
}

TEST(Ellipses, CrossedOnesAtOnePlaceAreNoCopies) {
  Points points;
  for (int i = 0; i < 400; ++i)
    for (const glm::vec3& normal : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 1, 0)}) {
      points.position.emplace_back(0.0, 0.5 * (i % 20), 0.3 * (i / 20));
      points.normal.push_back(normal);
      points.radius.push_back(0.4F);
      points.ellipse.push_back({{0, 0, 1}, 2.0F, 0.4F});
    }
  Input input;
  input.objects.emplace_back().points = points;
  BuildStats stats;
  const Scene scene = build_scene(std::move(input), {}, 0, stats);
  EXPECT_EQ(stats.ellipses, 800U);
  EXPECT_EQ(scene.data_pool.size(), 800U);
  EXPECT_EQ(stats.dropped_duplicates, 400U);
}

TEST(Gaussians, LessThanTheirHeaderSaysIsReadOrRefused) {
  const TempFolder folder;
  EXPECT_NE(read_error(folder.write("a.ply", packed_file(1, 257, "")))
                .find("found 1 chunks before 257 packed Gaussians, expected 2"),
            std::string::npos);
  EXPECT_NE(read_error(folder.write("b.ply",
                                    "ply\nformat ascii 1.0\nelement vertex 1\nproperty uint packed_position\n"
                                    "end_header\n7\n"))
                .find("'vertex' has no property 'packed_rotation'"),
            std::string::npos);
  EXPECT_NE(read_error(folder.write("d.ply", plain_head(1) + plain_row("1 2 3", "-4", "1 0 0 0")))
                .find("0 points stand"),
            std::string::npos);
  const auto cut = folder.write(
      "c.ply", plain_head(3) + plain_row("1 2 3", "40", "1 0 0 0") + plain_row("1 2 4", "40", "1 0 0 0"));
  const Input input = read_input({cut}, {});
  EXPECT_GE(input.objects.at(0).points.size(), 2U);
  EXPECT_TRUE(has_note(input, "found 2 rows of element 'vertex'"));
}

TEST(Gaussians, CapturesInOtherFormatsAreRefusedInOneSentence) {
  const TempFolder folder;
  for (const char* name : {"a.spz", "a.sog", "a.KSPLAT", "a.splat"})
    EXPECT_NE(read_error(folder.write(name, "anything")).find("found a capture of 3D Gaussians"),
              std::string::npos)
        << name;
  const std::string opacity =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
      "property float opacity\nend_header\n0 0 0 1\n";
  EXPECT_EQ(read_input({folder.write("c.ply", opacity)}, {}).objects.size(), 1U)
      << "an opacity alone is none";
}

}  // namespace
}  // namespace splatray
