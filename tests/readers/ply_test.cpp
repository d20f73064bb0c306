/// PLY in every flavour, and what is wrong with files.
#include "tests/readers/read_error.h"

#include <algorithm>
#include <cmath>

namespace splatray {
namespace {

const std::string ASCII_MESH =
    "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 5\nproperty float x\nproperty float y\n"
    "property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n1 1 0\n0 1 0\n9 9 9\n4 0 1 2 3\n3 0 2 1\n";

template <class T>
std::string swapped(T value, bool swap) {
  std::string bytes = bytes_of(value);
  if (swap) {
    std::reverse(bytes.begin(), bytes.end());
  }
  return bytes;
}

/// Two points with everything: double positions, normals, 8-bit colours, a radius and two unknown properties.
std::string binary_points(bool big_endian) {
  std::string text =
      "ply\nformat binary_" + std::string(big_endian ? "big" : "little") +
      "_endian 1.0\nelement vertex 2\nproperty double x\nproperty double y\nproperty double z\n"
      "property float nx\nproperty float ny\nproperty float nz\nproperty uchar red\n"
      "property uchar green\nproperty uchar blue\nproperty float radius\nproperty short confidence\n"
      "property list uchar int scan_id\nend_header\n";
  for (int i = 0; i < 2; ++i) {
    for (const double v : {4e6 + 0.001 * i, 4.9e6 + 0.001, -0.5}) {
      text += swapped(v, big_endian);
    }
    for (const float v : {0.0F, 0.0F, 2.0F}) {
      text += swapped(v, big_endian);
    }
    text += "\xFF" + std::string(1, '\0') + "\x80";
    text += swapped(0.25F, big_endian) + swapped(std::int16_t{7}, big_endian);
    text += "\x02" + swapped(1, big_endian) + swapped(2, big_endian);
  }
  return text;
}

Points read_one(const TempFolder& folder, const std::string& bytes) {
  Input input = read_input({folder.write("one.ply", bytes)}, {});
  EXPECT_EQ(input.objects.size(), 1U);
  return input.objects.front().points;
}

TEST(Ply, BinaryOfBothEndiansKeepsDoublesAndNamesWhatItSkips) {
  const TempFolder folder;
  for (const bool big_endian : {false, true}) {
    const Input input = read_input({folder.write("p.ply", binary_points(big_endian))}, {});
    const Points& points = input.objects.front().points;
    ASSERT_EQ(points.size(), 2U);
    EXPECT_DOUBLE_EQ(points.position[1].x, 4e6 + 0.001);
    EXPECT_DOUBLE_EQ(points.position[0].y, 4.9e6 + 0.001);
    EXPECT_FLOAT_EQ(points.normal[1].z, 2.0F);
    EXPECT_FLOAT_EQ(points.color[0].x, 1.0F);
    EXPECT_FLOAT_EQ(points.color[0].y, 0.0F);
    EXPECT_NEAR(points.color[0].z, 0.2158605F, 1e-6F);
    EXPECT_FLOAT_EQ(points.radius[1], 0.25F);
    EXPECT_TRUE(has_note(input, "skipped vertex properties 'scan_id'"));
  }
}

TEST(Ply, AsciiWithCrLfPlusSignsAndBlankLines) {
  const TempFolder folder;
  const Points points = read_one(folder,
                                 "ply\r\nformat ascii 1.0\r\nelement vertex 2\r\nproperty double x\r\n"
                                 "property double y\r\nproperty double z\r\nend_header\r\n"
                                 "4000000.001 +1e3 -2\r\n\r\n nan inf 0 \r\n");
  ASSERT_EQ(points.size(), 2U);
  EXPECT_DOUBLE_EQ(points.position[0].x, 4000000.001);
  EXPECT_DOUBLE_EQ(points.position[0].y, 1000.0);
  EXPECT_TRUE(std::isnan(points.position[1].x));
  EXPECT_TRUE(std::isinf(points.position[1].y));
}

TEST(Ply, ColoursOf16BitsFloatsAndEightBitsInSixteen) {
  const TempFolder folder;
  const auto with = [&](const std::string& type, const std::string& values) {
    return read_one(folder,
                    "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                    "property float z\nproperty " +
                        type + " diffuse_red\nproperty " + type + " diffuse_green\nproperty " + type +
                        " diffuse_blue\nend_header\n0 0 0 " + values + "\n")
        .color[0];
  };
  EXPECT_FLOAT_EQ(with("ushort", "65535 0 32896").x, 1.0F);
  EXPECT_NEAR(with("ushort", "65535 0 32896").z, 0.2158605F, 1e-4F);
  EXPECT_NEAR(with("ushort", "255 0 128").z, 0.2158605F, 1e-6F);
  EXPECT_NEAR(with("float", "1 0 0.5").z, 0.2140411F, 1e-6F);
  EXPECT_NEAR(with("float", "255 0 128").z, 0.2158605F, 1e-6F);
}

TEST(Ply, FacesAreFansAndUnusedVerticesAreDropped) {
  const TempFolder folder;
  const Input input = read_input({folder.write("m.ply", ASCII_MESH)}, keeping_meshes());
  const Mesh& mesh = input.objects.front().meshes.at(0);
  ASSERT_EQ(mesh.triangles.size(), 3U);
  EXPECT_EQ(mesh.triangles[1], glm::uvec3(0, 2, 3));
  for (const glm::dvec3& position : input.objects.front().points.position) {
    EXPECT_LT(position.x, 2.0);
  }
}

TEST(Ply, StripsAreTriangles) {
  const TempFolder folder;
  const Input input =
      read_input({folder.write("s.ply",
                               "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                               "property float z\nelement tristrips 1\nproperty list int int vertex_indices\n"
                               "end_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n8 0 1 2 3 -1 3 2 1\n")},
                 keeping_meshes());
  const std::vector<glm::uvec3>& triangles = input.objects[0].meshes[0].triangles;
  ASSERT_EQ(triangles.size(), 3U);
  EXPECT_EQ(triangles[1], glm::uvec3(2, 1, 3));
  EXPECT_EQ(triangles[2], glm::uvec3(3, 2, 1));
}

TEST(Ply, TruncationAtEveryByteIsAnErrorOrAValidInput) {
  const TempFolder folder;
  read_every_prefix(folder, "t.ply", ASCII_MESH);
  read_every_prefix(folder, "t.ply", binary_points(false));
  read_every_prefix(folder, "t.ply", binary_points(true));
}

TEST(Ply, EveryCorruptByteIsAnErrorOrAValidInput) {
  const TempFolder folder;
  const std::string good = binary_points(false);
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 0x81);
    const std::filesystem::path file = folder.write("c.ply", bad);
    try {
      static_cast<void>(read_input({file}, {}));
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::input_unreadable) << error.what();
    }
  }
}

TEST(Ply, CountsAreCheckedAgainstTheFileBeforeAnythingIsAllocated) {
  const TempFolder folder;
  const auto with_count = [&](const std::string& count) {
    return folder.write("n.ply", "ply\nformat binary_little_endian 1.0\nelement vertex " + count +
                                     "\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
                                     "0123456789ab");
  };
  EXPECT_EQ(read_input({with_count("1")}, {}).objects[0].points.size(), 1U);
  for (const std::string count : {"2", "4000000000"}) {
    const Input cut = read_input({with_count(count)}, {});
    EXPECT_EQ(cut.objects[0].points.size(), 1U);
    EXPECT_LT(cut.objects[0].points.position.capacity(), 100U);
    EXPECT_TRUE(has_note(cut, "found 1 rows of element 'vertex', expected " + count));
  }
  EXPECT_NE(read_error(with_count("18446744073709551615")).find("at most"), std::string::npos);
  EXPECT_NE(read_error(with_count("99999999999999999999999")).find("whole number"), std::string::npos);
  EXPECT_NE(read_error(with_count("-1")).find("whole number"), std::string::npos);
}

TEST(Ply, ErrorsNameTheLine) {
  const TempFolder folder;
  std::string bad = ASCII_MESH;
  bad.replace(bad.find("4 0 1 2 3"), 9, "4 0 1 2 7");
  EXPECT_NE(read_error(folder.write("i.ply", bad))
                .find("line 16: found a face that uses vertex 7, expected less than 5"),
            std::string::npos);
  bad = ASCII_MESH;
  bad.replace(bad.find("1 1 0\n"), 6, "1 x 0\n");
  EXPECT_NE(read_error(folder.write("x.ply", bad)).find("line 13: found 'x', expected a number"),
            std::string::npos);
}

TEST(Input, WhatIsNoInputIsOneSentence) {
  const TempFolder folder;
  EXPECT_NE(read_error(folder.path() / "missing.ply").find("no such file"), std::string::npos);
  EXPECT_NE(read_error(folder.write("empty.ply", "")).find("empty"), std::string::npos);
  EXPECT_NE(
      read_error(folder.write("a.abc", "1 2 3")).find(".ply .obj .stl .vtk .vtp .vtu .pvtp .pvtu .gltf .glb"),
      std::string::npos);
  std::filesystem::create_directory(folder.path() / "folder.ply");
  EXPECT_NE(read_error(folder.path() / "folder.ply").find("found a folder without scans"), std::string::npos);
  EXPECT_NE(read_error(folder.write("none.ply",
                                    "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\n"
                                    "property float y\nproperty float z\nend_header\n"))
                .find("no points"),
            std::string::npos);
}

TEST(Input, SeveralFilesAreSeveralObjects) {
  const TempFolder folder;
  const Input input =
      read_input({folder.write("a.PLY", ASCII_MESH), folder.write("b.ply", binary_points(false))}, {});
  ASSERT_EQ(input.objects.size(), 2U);
  EXPECT_EQ(input.objects[0].name, "a");
  EXPECT_EQ(input.objects[1].points.size(), 2U);
  EXPECT_NE(input.objects[0].material.flags & MATERIAL_TWO_SIDED, 0U);
}

}  // namespace
}  // namespace splatray
