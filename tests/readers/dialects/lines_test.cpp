/// Ends of lines and byte order marks, in all formats that are text or begin with it.
#include "preprocess/read/text/line_blocks.h"
#include "tests/readers/read_error.h"

namespace splatray {
namespace {

std::string with_ends(const std::string& text, const std::string& end) {
  std::string changed;
  for (const char c : text) changed += c == '\n' ? end : std::string(1, c);
  return changed;
}

std::string utf16(const std::string& text, bool mark) {
  std::string wide = mark ? "\xFF\xFE" : "";
  for (const char c : text) wide += std::string(1, c) + '\0';
  return wide;
}

const std::string PLY_HEAD =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
    "z\nend_header\n";
const std::string PCD_HEAD =
    "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 3\nHEIGHT 1\nPOINTS 3\n";
const std::string ROWS = "1 2 3\n4 5 6\n7 8 10\n";

/// Files of three points, by name.
const std::pair<const char*, std::string> FILES[] = {
    {"a.xyz", ROWS},
    {"b.csv", "x,y,z\n1,2,3\n4,5,6\n7,8,10\n"},
    {"c.pts", "3\n" + ROWS},
    {"d.ptx",
     "3\n1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n1 2 3 0\n4 5 6 0\n7 8 10 0\n"},
    {"e.ply", PLY_HEAD + ROWS},
    {"f.pcd", PCD_HEAD + "DATA ascii\n" + ROWS},
    {"g.obj", "v 1 2 3\nv 4 5 6\nv 7 8 10\n"},
    {"h.stl",
     "solid s\nfacet normal 0 0 1\nouter loop\nvertex 1 2 3\nvertex 4 5 6\nvertex 7 8 10\nendloop\nendfacet\n"
     "endsolid s\n"},
};

TEST(Lines, EndInLfOrCrOrBothAndMayBeginWithAMark) {
  const TempFolder folder;
  for (const auto& [name, text] : FILES)
    for (const std::string end : {"\n", "\r\n", "\r"})
      for (const std::string mark : {"", "\xEF\xBB\xBF"}) {
        const Input input = read_input({folder.write(name, mark + with_ends(text, end))}, keeping_meshes());
        const InputObject& object = input.objects.at(0);
        const Points& points = object.meshes.empty() ? object.points : object.meshes[0].vertices;
        ASSERT_EQ(points.size(), 3U) << name << " " << end.size() << mark;
        EXPECT_EQ(points.position[2], glm::dvec3(7, 8, 10)) << name;
      }
}

TEST(Lines, Utf16IsRefusedByName) {
  const TempFolder folder;
  for (const auto& [name, text] : FILES)
    for (const bool mark : {true, false})
      EXPECT_NE(read_error(folder.write(name, utf16(text, mark))).find("text in UTF-16, expected UTF-8"),
                std::string::npos)
          << name;
}

/// A first byte of the body that is LF is the body's, where the header's lines end in CR.
TEST(Lines, BinaryBodiesBeginBehindTheHeadersLastEnd) {
  const TempFolder folder;
  const float first = 1.00000119F;  // bytes 0A 00 80 3F
  ASSERT_EQ(bytes_of(first)[0], '\n');
  std::string ply = PLY_HEAD;
  ply.replace(ply.find("ascii"), 5, "binary_little_endian");
  ply.replace(ply.find("vertex 3"), 8, "vertex 1");
  std::string pcd = PCD_HEAD + "DATA binary\n";
  pcd.replace(pcd.find("WIDTH 3"), 7, "WIDTH 1").replace(pcd.find("POINTS 3"), 8, "POINTS 1");
  const std::string body = bytes_of(first) + bytes_of(2.0F) + bytes_of(3.0F);
  for (const auto& [name, text] : {std::pair("a.ply", ply), {"b.pcd", pcd}})
    for (const std::string end : {"\n", "\r\n", "\r"}) {
      const Points points =
          read_input({folder.write(name, with_ends(text, end) + body)}, {}).objects.at(0).points;
      EXPECT_EQ(points.position.at(0), glm::dvec3(double(first), 2, 3)) << name << " " << end.size();
    }
}

/// CR LF across the blocks that files are read in is one end.
TEST(Lines, EndsAcrossBlocksAreOne) {
  const TempFolder folder;
  for (const std::string end : {"\r\n", "\r"})
    for (std::size_t pad = 0; pad < 4; ++pad) {
      std::string text = "#" + std::string(pad, '-') + end;
      const std::string row = "1 2 3" + end;
      while (text.size() < 5 * LineBlocks::BLOCK_BYTES / 4) text += row;
      const std::string last = "x";
      const auto rows = (text.size() - 1 - pad - end.size()) / row.size();
      EXPECT_NE(
          read_error(folder.write("a.xyz", text + last + end)).find("line " + std::to_string(rows + 2) + ":"),
          std::string::npos);
    }
}

TEST(Lines, VtkThatItsLibraryCannotReadSaysWhy) {
  const TempFolder folder;
  const std::string vtk =
      "# vtk DataFile Version 3.0\ntitle\nASCII\nDATASET POLYDATA\nPOINTS 1 float\n1 2 3\n";
  EXPECT_NE(read_error(folder.write("a.vtk", with_ends(vtk, "\r"))).find("lines that end in CR"),
            std::string::npos);
  EXPECT_NE(read_error(folder.write("b.vtk", with_ends(vtk + std::string(300, ' '), "\r")))
                .find("lines that end in CR"),
            std::string::npos);
  EXPECT_NE(read_error(folder.write("c.vtk", "\xEF\xBB\xBF" + vtk)).find("byte order mark"),
            std::string::npos);
  EXPECT_NE(read_error(folder.write("d.vtk", utf16(vtk, true))).find("UTF-16"), std::string::npos);
}

}  // namespace
}  // namespace splatray
