/// PLY as people have it: numbers on any lines, names in any case, types that no one needs, files that were cut.
#include <sstream>

#include "tests/readers/scan_reading.h"

namespace splatray {
namespace {

std::string head(const std::string& format, const std::string& count, const std::string& more = "") {
  return "ply\nformat " + format + " 1.0\nelement vertex " + count +
         "\nproperty float x\nproperty float y\nproperty float z\n" + more;
}

class PlyDialects : public ::testing::Test {
 protected:
  Input read(const std::string& bytes, const ReadOptions& options = {}) {
    return read_input({folder_.write("a.ply", bytes)}, options);
  }
  Points points(const std::string& bytes) { return read(bytes).objects.at(0).points; }
  std::string error(const std::string& bytes) { return read_error(folder_.write("e.ply", bytes)); }
  TempFolder folder_;
};

TEST_F(PlyDialects, NumbersStandOnAnyLines) {
  const std::string colors = "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n";
  for (const std::string rows : {"1 2 3\n255 0 0\n\n4 5 6\n0 0 0\n", "1 2 3 255 0 0 4 5 6 0 0 0\n",
                                 "1\n2\n3\n255\n0\n0\n4 5 6 0\n0\n0", "  1 2 3\t255 0 0 \n4 5 6 0 0 0"}) {
    const Points read = points(head("ascii", "2", colors) + rows);
    ASSERT_EQ(read.size(), 2U) << rows;
    EXPECT_EQ(read.position[1], glm::dvec3(4, 5, 6)) << rows;
    EXPECT_FLOAT_EQ(read.color[0].x, 1.0F) << rows;
    EXPECT_FLOAT_EQ(read.color[1].x, 0.0F) << rows;
  }
}

/// Rows that are not what the header says must not become other points.
TEST_F(PlyDialects, RowsOfOtherWidthsAreRefused) {
  const std::string four = head("ascii", "4", "property float intensity\nend_header\n");
  EXPECT_NE(error(four + "1 2 3\n1 2 4\n1 2 5\n1 2 6\n").find("line 10: the line ends within a row"),
            std::string::npos);
  const std::string three = head("ascii", "4", "end_header\n");
  EXPECT_NE(error(three + "1 2 3 9\n1 2 4 9\n1 2 5 9\n1 2 6 9\n").find("the line ends within a row"),
            std::string::npos);
  EXPECT_NE(error(three + "1 2 3 0 0 1\n1 2 4 0 0 1\n1 2 5 0 0 1\n1 2 6 0 0 1\n").find("numbers follow"),
            std::string::npos);
  const std::string six =
      head("ascii", "4", "property float nx\nproperty float ny\nproperty float nz\nend_header\n");
  EXPECT_NE(error(six + "1 2 3\n1 2 4\n1 2 5\n1 2 6\n").find("found a line for each of 4 rows"),
            std::string::npos);
  EXPECT_NE(error(three + "1,5 2 3\n1 2 4\n1 2 5\n1 2 6\n").find("with a decimal comma"), std::string::npos);
}

TEST_F(PlyDialects, NamesInAnyCaseAndAliases) {
  for (const auto& [axes, colors] : {std::pair("X Y Z", "Red Green Blue"),
                                     {"x y z", "DIFFUSE_RED Diffuse_Green diffuse_blue"},
                                     {"x y z", "r g b"}}) {
    std::string text = "PLY\nFORMAT ASCII 1.0\nElement Vertex 1\n";
    std::istringstream words(std::string(axes) + " " + colors + " normal_x normal_y normal_z");
    for (std::string name; words >> name;) text += "Property Float " + name + "\n";
    const Points read = points(text + "End_Header\n1 2 3 255 0 0 0 0 1\n");
    EXPECT_EQ(read.position.at(0), glm::dvec3(1, 2, 3));
    EXPECT_FLOAT_EQ(read.color.at(0).x, 1.0F);
    EXPECT_EQ(read.normal.at(0), glm::vec3(0, 0, 1));
  }
}

TEST_F(PlyDialects, PropertiesThatNoOneNeedsMayBeOfAnyType) {
  for (const auto& [type, bytes] :
       {std::pair("int64", 8), {"uint64", 8}, {"bool", 1}, {"half", 2}, {"long", 8}}) {
    const Points read =
        points(head("binary_little_endian", "2", std::string("property ") + type + " id\nend_header\n") +
               bytes_of(1.0F) + bytes_of(2.0F) + bytes_of(3.0F) + std::string(std::size_t(bytes), '\1') +
               bytes_of(4.0F) + bytes_of(5.0F) + bytes_of(6.0F) + std::string(std::size_t(bytes), '\2'));
    ASSERT_EQ(read.size(), 2U) << type;
    EXPECT_EQ(read.position[1], glm::dvec3(4, 5, 6)) << type;
  }
  EXPECT_EQ(points(head("ascii", "1", "property string label\nend_header\n") + "1 2 3 chair\n").size(), 1U);
  EXPECT_NE(
      error(head("binary_little_endian", "1", "property string label\nend_header\n")).find("type 'string'"),
      std::string::npos);
  const std::string half =
      "ply\nformat binary_big_endian 1.0\nelement vertex 1\nproperty half x\nproperty half y\n"
      "property half z\nend_header\n\x3C\x01\xC0";
  EXPECT_EQ(points(half + std::string("\0\0\0", 3)).position.at(0),
            glm::dvec3(1.0 + 1.0 / 1024.0, -2.0, 0.0));
}

TEST_F(PlyDialects, WhatACutHasLeftIsRead) {
  const std::string binary =
      head("binary_little_endian", "3", "end_header\n") + bytes_of(1.0F) + bytes_of(2.0F) + bytes_of(3.0F);
  for (const std::string& bytes :
       {binary + bytes_of(4.0F), binary, head("ascii", "3", "end_header\n") + "1 2 3\n4 5",
        head("ascii", "3", "end_header\n") + "1 2 3\n4 5 6",
        head("ascii", "3", "end_header\n") + "1\n2\n3\n4\n5"}) {
    const Input input = read(bytes);
    EXPECT_EQ(input.objects.at(0).points.size(), 1U) << bytes;
    EXPECT_TRUE(has_note(input, "found 1 rows of element 'vertex', expected 3 as the header says")) << bytes;
    EXPECT_NE(strict_error(folder_.path() / "a.ply").find("found 1 rows"), std::string::npos);
  }
  const std::string faces =
      head("ascii", "4", "element face 3\nproperty list uchar int vertex_indices\nend_header\n") +
      "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2";
  const Input cut = read(faces, keeping_meshes());
  EXPECT_EQ(cut.objects.at(0).meshes.at(0).triangles.size(), 1U);
  EXPECT_TRUE(has_note(cut, "found 1 rows of element 'face', expected 3"));
  EXPECT_FALSE(has_note(cut, "nothing of"));
  const std::string too_many =
      head("ascii", "9", "element face 1\nproperty list uchar int vertex_indices\nend_header\n") +
      "0 0 0\n1 0 0\n1 1 0\n3 0 1 2\n";
  EXPECT_TRUE(has_note(read(too_many, keeping_meshes()),
                       "nothing of 'face': the file was cut off or the count is wrong"));
}

}  // namespace
}  // namespace splatray
