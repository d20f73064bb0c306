/// Points as text whose columns are named, asked for or guessed.
#include "engine/base/srgb.h"
#include "tests/readers/scan_reading.h"

namespace splatray {
namespace {

class Xyz : public ::testing::Test {
 protected:
  ReadScan read(const std::string& text, const ScanOptions& options = {}) {
    return read_scan(folder_.write("a.txt", text), options);
  }
  std::string error(const std::string& text, const std::string& columns = "") {
    ReadOptions options;
    options.scans.columns = columns;
    return read_error(folder_.write("e.txt", text), options);
  }
  double value(const ReadScan& scan, std::string_view column, std::size_t i) {
    const Column* found = find_column(scan.file.points.columns, column);
    EXPECT_NE(found, nullptr) << column;
    return found == nullptr ? -1e9 : found->number(i);
  }
  TempFolder folder_;
};

const glm::dvec3 FIRST(1.5, -2.0, 3e6);

TEST_F(Xyz, SeparatorsAreFound) {
  for (const std::string text :
       {"1.5 -2 3e6\n4 5 6\n", "1.5,-2,3e6\n4,5,6\n", " 1.5 , -2 , 3e6 \n4,5,6,\n", "1,5;-2;3e6\n4;5;6\n",
        "1.5\t-2\t3e6\n4\t5\t6\n", "1,5\t-2,0\t3e6\n4\t5\t6\n", "1.5 -2\t3e6\n4 5\t6\n",
        "\xEF\xBB\xBF# made by hand\r\n// again\r\n2\r\n1.5 -2 3e6\r\n\r\n4 5 6\r\n",
        "\"1.5\",\"-2\",\"3e6\"\n4,5,6\n"}) {
    const ReadScan scan = read(text);
    ASSERT_EQ(scan.file.points.size(), 2U) << text;
    EXPECT_EQ(scan.file.points.position[0], FIRST) << text;
    EXPECT_EQ(scan.file.points.position[1], glm::dvec3(4, 5, 6)) << text;
    EXPECT_EQ(scan.file.up, glm::dvec3(0, 0, 1));
  }
}

TEST_F(Xyz, HeadersNameColumns) {
  const ReadScan scan = read(
      "\"X "
      "[m]\",Y,\"Z\",Intensity,ReturnNumber,NumberOfReturns,Classification,PointSourceId,GpsTime,Red,Green,"
      "Blue,"
      "Nx,Ny,Nz,Flag\n"
      "1.5,-2,3e6,7.5,1,2,6,300,123456789.125,255,128,0,0,0,1,1\n"
      "4,5,6,,1,1,2,300,123456790.25,0,1,2,nan,0,1,1\n");
  const Points& points = scan.file.points;
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points.position[0], FIRST);
  EXPECT_EQ(value(scan, COLUMN_INTENSITY, 0), 7.5);
  EXPECT_EQ(value(scan, COLUMN_INTENSITY, 1), 0.0) << "an empty cell";
  EXPECT_EQ(value(scan, COLUMN_RETURNS, 0), 2.0);
  EXPECT_EQ(value(scan, COLUMN_CLASS, 0), 6.0);
  EXPECT_EQ(value(scan, COLUMN_SOURCE, 1), 300.0);
  EXPECT_EQ(value(scan, COLUMN_TIME, 0), 123456789.125) << "not rounded to float";
  EXPECT_EQ(points.stored_color[0], glm::u16vec3(255, 128, 0));
  EXPECT_EQ(points.stored_color_most, 0) << "8 or 16 bits: judged over all files";
  EXPECT_EQ(points.normal[0], glm::vec3(0, 0, 1));
  EXPECT_EQ(points.normal[1], glm::vec3(0)) << "to be estimated";
  EXPECT_TRUE(scan.has_note("skipped columns 'Flag'"));
}

TEST_F(Xyz, HeadersStandInCommentsAndOrder) {
  for (const std::string text :
       {"//z y x scalar_Intensity\n2\n3e6 -2 1.5 9\n6 5 4 9\n", "# z;y;x;i\n3e6;-2;1,5;9\n6;5;4;9\n",
        "lon,z,Y,x,Flag word\n77,3e6,-2,1.5,text\n1,6,5,4,more text\n"}) {
    const ReadScan scan = read(text);
    ASSERT_EQ(scan.file.points.size(), 2U) << text;
    EXPECT_EQ(scan.file.points.position[0], FIRST) << text;
  }
}

TEST_F(Xyz, HeadersOfParaViewNameColumns) {
  const ReadScan scan = read(
      "\"RGB:0\",\"RGB:1\",\"RGB:2\",\"Normals:0\",\"Normals:1\",\"Normals:2\",\"Points:0\",\"Points:1\","
      "\"Points:2\"\n"
      "255,128,0,0,0,1,1.5,-2,3e6\n");
  EXPECT_EQ(scan.file.points.position.at(0), FIRST);
  ASSERT_FALSE(scan.file.points.stored_color.empty());
  EXPECT_EQ(scan.file.points.stored_color[0], glm::u16vec3(255, 128, 0));
  ASSERT_FALSE(scan.file.points.normal.empty());
  EXPECT_EQ(scan.file.points.normal[0], glm::vec3(0, 0, 1));
  EXPECT_FALSE(read("Points:0,Points:1,Points:2,RGB:0,RGB:1,RGB:2\n1,2,3,4,5,6\n").has_note("skipped"));
}

TEST_F(Xyz, DegreesAreReported) {
  EXPECT_TRUE(read("Lon,Lat,Altitude\n8.5,47.3,400\n").has_note("degrees of longitude and latitude"));
  EXPECT_FALSE(read("Easting,Northing,Elevation\n2600000,1200000,400\n").has_note("degrees"));
}

TEST_F(Xyz, ColumnsAskedForOverride) {
  ScanOptions options;
  options.columns = "z,-,x,y,green,red,blue,echo";
  for (const std::string head : {"", "x y z r g b what ever\n"}) {
    const ReadScan scan = read(head + "3e6 word 1.5 -2 9 8 7 5\n6 word 4 5 3 2 1 6\n", options);
    ASSERT_EQ(scan.file.points.size(), 2U);
    EXPECT_EQ(scan.file.points.position[0], FIRST);
    EXPECT_EQ(scan.file.points.stored_color[0], glm::u16vec3(8, 9, 7));
    EXPECT_EQ(value(scan, "echo", 1), 6.0);
  }
  EXPECT_NE(error("1 2 3\n", "x,y,intensity").find("expected x, y and z"), std::string::npos);
}

TEST_F(Xyz, AttributesAskedForAreKept) {
  ScanOptions options;
  options.attributes = {"Echo Width"};
  const ReadScan scan = read("x,y,z,echo_width,other\n1,2,3,0.1,1\n", options);
  EXPECT_EQ(value(scan, "Echo Width", 0), 0.1);
  EXPECT_TRUE(scan.has_note("skipped columns 'other'"));
}

TEST_F(Xyz, NumbersOfScansAreStations) {
  const ReadScan scan = read("x y z scan_id\n1 2 3 7\n4 5 6 2\n7 8 9 7\n");
  ASSERT_EQ(scan.file.points.stations.size(), 2U);
  EXPECT_EQ(scan.file.points.stations[0].name, "2");
  EXPECT_EQ(scan.file.points.station, (std::vector<std::uint16_t>{1, 0, 1}));
  EXPECT_TRUE(read("x y z scan_id\n1 2 3 7.5\n").has_note("not whole"));
}

TEST_F(Xyz, ColumnsWithoutNamesAreGuessedAndReported) {
  EXPECT_TRUE(read("1 2 3\n").notes.empty());
  EXPECT_EQ(value(read("1 2 3 0.5\n"), COLUMN_INTENSITY, 0), 0.5);
  const ReadScan six = read("1 2 3 255 0 9\n1 2 3 0 0 1\n");
  EXPECT_EQ(six.file.points.stored_color.at(0), glm::u16vec3(255, 0, 9));
  EXPECT_TRUE(six.has_note("x, y, z, colours"));
  const ReadScan normals = read("1 2 3 0.6 0 0.8\n1 2 3 0 0 1\n");
  EXPECT_EQ(normals.file.points.normal.at(1), glm::vec3(0, 0, 1));
  EXPECT_TRUE(normals.file.points.stored_color.empty());
  EXPECT_FALSE(read("1 2 3 0 0 1\n1 2 3 0 0 -1\n").file.points.normal.empty())
      << "whole numbers, yet normals";
  const ReadScan seven = read("1 2 3 -700 1 2 3\n");
  EXPECT_EQ(value(seven, COLUMN_INTENSITY, 0), -700.0);
  EXPECT_EQ(seven.file.points.stored_color.at(0), glm::u16vec3(1, 2, 3));
  for (const std::string nine : {"1 2 3 10 20 30 0 1 0\n", "1 2 3 0 1 0 10 20 30\n"}) {
    const ReadScan scan = read(nine);
    EXPECT_EQ(scan.file.points.stored_color.at(0), glm::u16vec3(10, 20, 30)) << nine;
    EXPECT_EQ(scan.file.points.normal.at(0), glm::vec3(0, 1, 0)) << nine;
  }
  EXPECT_TRUE(read("1 2 3 4.5 -7 6\n").has_note("three unknown ones"));
  EXPECT_TRUE(read("1 2 3 4 5\n").has_note("2 columns behind x, y and z"));
}

TEST_F(Xyz, IntensityStandsWhereTheOthersAreColoursAndNormals) {
  struct Case {
    const char* rows;
    const char* order;
    double intensity;
  };
  for (const Case& one :
       {Case{"1 2 3 10 20 30 0.25\n4 5 6 255 0 9 0.5\n", "colours, intensity;", 0.25},
        {"1 2 3 10 20 30 1000\n4 5 6 255 0 9 200\n", "colours, intensity;", 1000.0},
        {"1 2 3 1000 10 20 30\n4 5 6 200 255 0 9\n", "intensity, colours;", 1000.0},
        {"1 2 3 10 20 30 0.25 0 0 1\n4 5 6 255 0 9 0.5 0 1 0\n", "colours, intensity, normals;", 0.25},
        {"1 2 3 10 20 30 0 0 1 0.25\n4 5 6 255 0 9 0 1 0 0.5\n", "colours, normals, intensity;", 0.25}}) {
    const ReadScan scan = read(one.rows);
    EXPECT_TRUE(scan.has_note(std::string("taken as x, y, z, ") + one.order)) << one.rows;
    EXPECT_EQ(value(scan, COLUMN_INTENSITY, 0), one.intensity) << one.rows;
    ASSERT_FALSE(scan.file.points.stored_color.empty()) << one.rows;
    EXPECT_EQ(scan.file.points.stored_color[0], glm::u16vec3(10, 20, 30)) << one.rows;
  }
  const ReadScan either = read("1 2 3 100 10 20 30\n4 5 6 200 255 0 9\n");
  EXPECT_TRUE(either.has_note("intensity, colours, though by its values intensity could stand elsewhere"));
  EXPECT_EQ(value(either, COLUMN_INTENSITY, 0), 100.0);
}

/// The stored red channel of the first point, as a share of full.
double red(const ReadScan& scan) {
  const Points& points = scan.file.points;
  const double most = points.stored_color_most == 0 ? 255.0 : points.stored_color_most;
  return points.stored_color.empty() ? -1.0 : points.stored_color[0].x / most;
}

TEST_F(Xyz, ColoursAreJudgedOverAllPoints) {
  const std::string head = "x y z r g b\n";
  EXPECT_NEAR(red(read(head + "1 2 3 128 0 0\n1 2 3 1 1 1\n")), 128.0 / 255.0, 1e-9);
  EXPECT_NEAR(red(read(head + "1 2 3 0.5 0 0\n1 2 3 1 1 1\n")), 0.5, 1e-5);
  EXPECT_NEAR(red(read(head + "1 2 3 1 0 0\n1 2 3 0 0 0\n")), 1.0, 1e-9)
      << "all 0 or 1: full, not almost black";
  EXPECT_NEAR(red(read(head + "1 2 3 127.5 0 0\n1 2 3 255 1 1\n")), 0.5, 1e-5);
  const ReadScan wide = read(head + "1 2 3 128 0 0\n1 2 3 65535 1 1\n");
  EXPECT_EQ(wide.file.points.stored_color[0].x, 128);
  const Input joined = read_input({folder_.write("w.txt", head + "1 2 3 128 0 0\n1 2 3 65535 1 1\n")}, {});
  EXPECT_FLOAT_EQ(joined.objects[0].points.color[0].x, srgb_to_linear(128.0F / 65535.0F))
      << "dark, not 8 bits";
}

TEST_F(Xyz, PointsWithoutAPositionAreCounted) {
  const ReadScan scan = read("x,y,z,i\n1,2,3,1\nnan,2,3,2\n,,,3\n4,5,inf,4\n5,6,7,5\n");
  EXPECT_EQ(scan.file.points.size(), 2U);
  EXPECT_EQ(scan.file.counts.no_return, 3U);
  EXPECT_EQ(value(scan, COLUMN_INTENSITY, 1), 5.0);
}

TEST_F(Xyz, CutsAndCounts) {
  EXPECT_EQ(read("1 2 3 4\n5 6 7 8\n9 9").file.points.size(), 2U) << "the last line is cut";
  EXPECT_EQ(read("1 2 3 4\n5 6 7 -").file.points.size(), 1U);
  EXPECT_EQ(read("1 2 3 4\n5 6 7 8").file.points.size(), 2U);
  const ReadScan low = read("1\n1 2 3\n4 5 6\n");
  EXPECT_EQ(low.file.counts.stored, 2U);
  EXPECT_TRUE(low.has_note("says 1 points, and 2 follow"));
  const auto high = folder_.write("h.txt", "5\n1 2 3\n4 5 6\n7 8 9.1");
  EXPECT_EQ(read_scan(high).file.counts.missing, 3U) << "the last line may have lost digits";
  EXPECT_NE(strict_error(high).find("found 2 points, expected 5"), std::string::npos);
}

TEST_F(Xyz, ErrorsNameTheLine) {
  EXPECT_NE(error("no such file\n").find("line 1: found 'no', 'such', 'file', expected numbers, or names"),
            std::string::npos);
  EXPECT_NE(error("x y z i\n1 2 3 4\n1 2 3\n1 2 3 4\n").find("line 3: found 3 columns, expected 4"),
            std::string::npos);
  EXPECT_NE(error("1 2 3\n1 2 3 4\n").find("line 2: found 4 columns, expected 3"), std::string::npos);
  EXPECT_NE(error("1 2\n").find("line 1: found 2 numbers"), std::string::npos);
  EXPECT_NE(error("1,2,3\n4,5,six\n").find("line 2: found 'six', expected a number"), std::string::npos);
  EXPECT_NE(error("x,y,z\n").find("found no points"), std::string::npos);
  EXPECT_NE(error("a,b,c\n1,2,3\n").find("expected numbers, or names of columns"), std::string::npos);
}

TEST_F(Xyz, EveryPrefixIsAnErrorOrAValidInput) {
  read_every_prefix(folder_, "p.csv", "x;y;z;r;g;b;scan\n1,5;2;3;10;20;30;1\n4;5;6;1;2;3;2\n");
}

TEST(Kitti, SweepsAreReadAndOtherFilesRefused) {
  const TempFolder folder;
  std::string bytes;
  for (const float v : {10.0F, -2.0F, 1.5F, 0.25F, 3.0F, 4.0F, 5.0F, 1.0F}) bytes += bytes_of(v);
  const ReadScan scan = read_scan(folder.write("a.bin", bytes));
  ASSERT_EQ(scan.file.points.size(), 2U);
  EXPECT_EQ(scan.file.points.position[0], glm::dvec3(10.0, -2.0, 1.5));
  EXPECT_EQ(find_column(scan.file.points.columns, COLUMN_INTENSITY)->number(0), 0.25);
  EXPECT_EQ(scan.file.points.stations.at(0).sensor_world, glm::dvec3(0.0));
  EXPECT_NE(read_error(folder.write("b.bin", bytes + "x")).find("found 33 bytes"), std::string::npos);
  EXPECT_NE(
      read_error(folder.write("c.bin", bytes + bytes_of(2e7F) + std::string(12, '\0'))).find("at byte 32"),
      std::string::npos);
  EXPECT_NE(read_error(folder.write("d.bin", std::string(32, '\xFF'))).find("no plausible point"),
            std::string::npos);
}

}  // namespace
}  // namespace splatray
