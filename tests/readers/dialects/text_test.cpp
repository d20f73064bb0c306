/// Points as text as people have them: separators, decimal commas, names, groups of digits, numbers of rows, raster grids.
#include "tests/readers/scan_reading.h"

namespace splatray {
namespace {

class TextDialects : public ::testing::Test {
 protected:
  ReadScan read(const std::string& name, const std::string& text, const std::string& columns = "") {
    ScanOptions options;
    options.columns = columns;
    return read_scan(folder_.write(name, text), options);
  }
  std::string error(const std::string& name, const std::string& text) {
    return read_error(folder_.write(name, text));
  }
  TempFolder folder_;
};

/// One point and a second, in rows that mean the same in files of all kinds.
TEST_F(TextDialects, SeparatorsAndCommasAreFoundAlikeInAllFormats) {
  const std::string rows[] = {
      "1.5 -2.25 3 10 20 30\n4 5 6 40 50 60\n",           "1,5 -2,25 3 10 20 30\n4 5 6 40 50 60\n",
      "1,5;-2,25;3;10;20;30\n4;5;6;40;50;60\n",           "1.5;-2.25;3;10;20;30\n4;5;6;40;50;60\n",
      "1,5\t-2,25\t3\t10\t20\t30\n4\t5\t6\t40\t50\t60\n", "1.5,-2.25,3,10,20,30\n4,5,6,40,50,60\n",
      "\"1,5\",\"-2,25\",3,10,20,30\n4,5,6,40,50,60\n",   "1.5, -2.25, 3, 10, 20, 30\n4, 5, 6, 40, 50, 60\n"};
  for (const std::string& text : rows)
    for (const char* name : {"a.xyz", "a.txt", "a.csv", "a.asc", "a.pts"}) {
      const ReadScan scan = read(name, text);
      ASSERT_EQ(scan.file.points.size(), 2U) << name << " " << text;
      EXPECT_EQ(scan.file.points.position[0], glm::dvec3(1.5, -2.25, 3)) << name << " " << text;
      EXPECT_EQ(scan.file.points.stored_color.at(1), glm::u16vec3(40, 50, 60)) << name << " " << text;
    }
}

TEST_F(TextDialects, PtxRowsTooHaveAnyForm) {
  const std::string head[] = {"2\n1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n",
                              "2\n1\n0;0;0\n1;0;0\n0;1;0\n0;0;1\n1;0;0;0\n0;1;0;0\n0;0;1;0\n0;0;0;1\n"};
  for (const std::string& text : {head[0] + "1,5 2 3 0,5\n4 5 6 0,5\n", head[1] + "1,5;2;3;0,5\n4;5;6;0,5\n",
                                  head[0] + "1.5 2 3 10 20 30\n4 5 6 1 2 3\n"}) {
    const ReadScan scan = read("a.ptx", text);
    ASSERT_EQ(scan.file.points.size(), 2U) << text;
    EXPECT_EQ(scan.file.points.position[0], glm::dvec3(1.5, 2, 3)) << text;
  }
}

TEST_F(TextDialects, PtsOfSixAndNineColumnsAndWithNames) {
  const ReadScan normals = read("a.pts", "2\n1 2 3 0 0.6 0.8\n4 5 6 0 0 -1\n");
  EXPECT_EQ(normals.file.points.normal.at(0), glm::vec3(0, 0.6F, 0.8F));
  EXPECT_TRUE(normals.file.points.stored_color.empty());
  const ReadScan nine = read("b.pts", "2\n1 2 3 10 20 30 0 0.6 0.8\n4 5 6 1 2 3 0 0 -1\n");
  EXPECT_EQ(nine.file.points.normal.at(1), glm::vec3(0, 0, -1));
  EXPECT_EQ(nine.file.points.stored_color.at(0), glm::u16vec3(10, 20, 30));
  for (const std::string text : {"2\nX;Y;Z;Intensity;R;G;B\n1;2;3;7;10;20;30\n4;5;6;8;1;2;3\n",
                                 "//X Y Z Intensity R G B\n2\n1 2 3 7 10 20 30\n4 5 6 8 1 2 3\n"}) {
    const ReadScan named = read("c.pts", text);
    ASSERT_EQ(named.file.points.size(), 2U) << text;
    EXPECT_EQ(find_column(named.file.points.columns, COLUMN_INTENSITY)->number(1), 8.0);
    EXPECT_EQ(named.file.points.stored_color.at(0), glm::u16vec3(10, 20, 30));
  }
  EXPECT_EQ(read("d.pts", "1\n1 2 3 4 5\n", "-,x,y,z").file.points.position.at(0), glm::dvec3(2, 3, 4));
  EXPECT_NE(error("e.pts", "1 2 3 4 5\n").find("--columns"), std::string::npos);
}

TEST_F(TextDialects, CellsBehindTheLastNameArePassedOver) {
  const std::string rows =
      "7 1 2 3 10 20 30 0.5 1 7 2 14\n9 4 5 6 1 2 3 0.5 1 8\n8 7 8 9 1 2 3 0.5 1 8 2 1 3 1\n";
  for (const ReadScan& scan :
       {read("points3D.txt",
             "# 3D point list with one line of data per point:\n#   POINT3D_ID, X, Y, Z, R, G, B, ERROR, "
             "TRACK[] as (IMAGE_ID, POINT2D_IDX)\n" +
                 rows),
        read("Points3D.TXT", rows), read("a.txt", rows, "-,x,y,z,r,g,b"),
        read("a.csv", "id x y z r g b\n" + rows)}) {
    ASSERT_EQ(scan.file.points.size(), 3U);
    EXPECT_EQ(scan.file.points.position[2], glm::dvec3(7, 8, 9));
    EXPECT_EQ(scan.file.points.stored_color.at(0), glm::u16vec3(10, 20, 30));
    EXPECT_TRUE(scan.has_note("behind the last named column"));
  }
  EXPECT_NE(error("b.csv", "x,y,z\n1,5,2,0,3,0\n").find("decimal commas need quotes"), std::string::npos);
  EXPECT_NE(error("d.txt", rows).find("--columns"), std::string::npos) << "of another name";
  EXPECT_NE(error("points3D.txt", "7 1 2 3 10 20 300 0.5\n7 1 2 3\n").find("--columns"), std::string::npos);
  EXPECT_NE(error("c.txt", "1 2 3\n1 2 3 4\n").find("--columns"), std::string::npos);
}

TEST_F(TextDialects, GroupsOfDigitsAndMissingCells) {
  for (const std::string text :
       {"x,y,z,i\n\"1,499,998.5\",\"-2,000.25\",\"3\",NULL\n4,5,6,7\n",
        "x;y;z;i\n1,499,998.5;-2,000.25;3;N/A\n4;5;6;7\n", "x;y;z;i\n1.499.998,5;-2.000,25;3;\n4;5;6;7\n",
        "x;y;z;i\n1'499'998.5;-2'000.25;3;nan\n4;5;6;7\n",
        "x y z i\n1,499,998.5 -2,000.25 3 null\n4 5 6 7\n"}) {
    const ReadScan scan = read("a.csv", text);
    ASSERT_EQ(scan.file.points.size(), 2U) << text;
    EXPECT_EQ(scan.file.points.position[0], glm::dvec3(1499998.5, -2000.25, 3)) << text;
    EXPECT_EQ(find_column(scan.file.points.columns, COLUMN_INTENSITY)->number(0), 0.0) << text;
  }
  const ReadScan holes = read("b.csv", "x,y,z\n1,2,NULL\n4,5,6\nNone,5,6\n");
  EXPECT_EQ(holes.file.points.size(), 1U);
  EXPECT_EQ(holes.file.counts.no_return, 2U);
  std::string late = "x y z\n";
  for (int i = 0; i < 100; ++i) late += "1.5 2 3\n";
  EXPECT_NE(error("c.csv", late + "1,5 2 3\n").find("'1,5' with a decimal comma"), std::string::npos);
}

TEST_F(TextDialects, FirstColumnsThatCountAreLeftOut) {
  for (const int first : {0, 1}) {
    std::string text;
    for (int i = 0; i < 200; ++i)
      text += std::to_string(first + i + (i > 150 ? 3 : 0)) + " " + std::to_string(i % 15) + ".125 " +
              std::to_string(i / 15) + " 0.5\n";
    for (const char* name : {"a.txt", "a.pts"}) {
      const ReadScan scan = read(name, text);
      ASSERT_EQ(scan.file.points.size(), 200U);
      EXPECT_EQ(scan.file.points.position[16], glm::dvec3(1.125, 1, 0.5));
      EXPECT_TRUE(scan.has_note("counts the rows"));
    }
  }
}

TEST_F(TextDialects, NumbersOfRowsBeginAnywhereInLongFiles) {
  std::string text;
  for (int i = 0; i < 100; ++i) text += std::to_string(i + 1001) + ";" + std::to_string(i % 9) + ";1.5D0;3\n";
  const ReadScan scan = read("a.csv", text);
  EXPECT_EQ(scan.file.points.position.at(10), glm::dvec3(1, 1.5, 3));
  EXPECT_TRUE(scan.has_note("counts the rows"));
}

TEST_F(TextDialects, MeshesWithDecimalCommasSaySo) {
  EXPECT_NE(error("a.obj", "v 0,5 0 0\n").find("'0,5' with a decimal comma"), std::string::npos);
  EXPECT_NE(error("a.stl", "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0,5 0 0\n")
                .find("'0,5' with a decimal comma"),
            std::string::npos);
}

/// A raster's x counts too, but begins anew.
TEST_F(TextDialects, CoordinatesThatCountAreKept) {
  std::string text;
  for (int i = 0; i < 300; ++i) text += std::to_string(i % 100) + " " + std::to_string(i / 100) + " 0.5 9\n";
  const ReadScan scan = read("a.txt", text);
  EXPECT_EQ(scan.file.points.position.at(101), glm::dvec3(1, 1, 0.5));
  EXPECT_FALSE(scan.has_note("counts the rows"));
  EXPECT_EQ(read("b.txt", "0 1 2\n1 5 6\n2 9 9\n").file.points.position.at(2), glm::dvec3(2, 9, 9))
      << "x, y and z alone";
}

TEST_F(TextDialects, RasterGridsArePointsInTheMiddlesOfTheirCells) {
  const std::string cells = "1 2 -9999\n4 5\n6\n";
  const ReadScan scan = read(
      "a.asc", "ncols 3\nnrows 2\nxllcorner 100\nyllcorner 200\ncellsize 10\nNODATA_value -9999\n" + cells);
  ASSERT_EQ(scan.file.points.size(), 5U);
  EXPECT_EQ(scan.file.points.position[0], glm::dvec3(105, 215, 1));
  EXPECT_EQ(scan.file.points.position[4], glm::dvec3(125, 205, 6));
  EXPECT_EQ(scan.file.counts.no_return, 1U);
  EXPECT_TRUE(scan.has_note("raster grid of 3 x 2"));
  const ReadScan centre =
      read("b.txt",
           "NROWS 2\r\nNCOLS 3\r\nXLLCENTER 100,5\r\nYLLCENTER 200\r\nDX 10\r\nDY 20\r\n1,5 2 3 4 5 6\r\n");
  EXPECT_EQ(centre.file.points.position.at(0), glm::dvec3(100.5, 220, 1.5));
  const auto cut = folder_.write("c.asc", "ncols 3\nnrows 2\nxllcorner 1\nyllcorner 2\ncellsize 1\n1 2 3\n");
  EXPECT_EQ(read_scan(cut).file.counts.missing, 3U);
  EXPECT_NE(strict_error(cut).find("found 3 points, expected 6"), std::string::npos);
  EXPECT_NE(error("d.asc", "ncols 3\nnrows 2\ncellsize 1\n1 2 3\n").find("without xllcorner"),
            std::string::npos);
  EXPECT_NE(error("e.asc", "ncols 3.5\nnrows 2\nxllcorner 1\nyllcorner 1\ncellsize 1\n1 2 3\n")
                .find("found ncols 3.5"),
            std::string::npos);
  for (const auto& [size, sentence] : {std::pair("0", "cells of the size 0, expected a positive one"),
                                       {"-10", "cells of the size -10"},
                                       {"inf", "without cellsize"},
                                       {"1e308", "beyond all numbers"}})
    EXPECT_NE(error("f.asc", std::string("ncols 3\nnrows 2\nxllcorner 1\nyllcorner 1\ncellsize ") + size +
                                 "\n1 2 3\n4 5 6\n")
                  .find(sentence),
              std::string::npos)
        << size;
}

}  // namespace
}  // namespace splatray
