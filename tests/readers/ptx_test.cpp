/// PTX and what is wrong with real ones.
#include "tests/readers/scan_reading.h"

namespace splatray {
namespace {

const std::string AXES = "1 0 0\n0 1 0\n0 0 1\n";

std::string header(int columns, int rows, const std::string& position, const std::string& linear = AXES) {
  std::string matrix = linear;
  for (std::size_t at = matrix.find('\n'); at != std::string::npos; at = matrix.find('\n', at + 3))
    matrix.insert(at, " 0");
  return std::to_string(columns) + "\n" + std::to_string(rows) + "\n" + position + "\n" + AXES + matrix +
         position + " 1\n";
}

/// Two columns of three rows; the cell of column 1, row 0 has no return.
const std::string CELLS = "1 0 0 0.1\n1 0 1 0.2\n1 0 2 0.3\n0 0 0 0.5\n2 0 1 0.5\n2 0 2 0.6\n";

TEST(Ptx, CellsWithoutReturnKeepTheirPlaceInTheGrid) {
  const TempFolder folder;
  const ReadScan read = read_scan(folder.write("a.ptx", header(2, 3, "0 0 0") + CELLS));
  const Points& points = read.file.points;
  ASSERT_EQ(points.size(), 5U);
  EXPECT_EQ(read.file.counts.stored, 6U);
  EXPECT_EQ(read.file.counts.no_return, 1U);
  EXPECT_EQ(read.file.counts.missing, 0U);
  EXPECT_EQ(points.stations.at(0).rows, 3U);
  EXPECT_EQ(points.stations.at(0).columns, 2U);
  EXPECT_EQ(points.grid_cell, (std::vector<std::uint32_t>{0, 2, 4, 3, 5}));
  EXPECT_EQ(points.stations[0].sensor_world, glm::dvec3(0.0));
  EXPECT_FLOAT_EQ(static_cast<float>(find_column(points.columns, COLUMN_INTENSITY)->number(3)), 0.5F);
  EXPECT_TRUE(read.notes.empty()) << read.notes[0];
}

TEST(Ptx, SeveralScansHaveTheirTransformsInDouble) {
  const TempFolder folder;
  const std::string turned = "0 1 0\n-1 0 0\n0 0 1\n";
  const ReadScan read = read_scan(folder.write(
      "a.ptx", header(1, 2, "4000000.001 4900000.002 100") + "1 0 0 0.5 255 0 10\n0 0 3 0.5 9 9 9\n" +
                   header(1, 1, "4000010 4900000 100", turned) + "1 0 0.5 1"));
  const Points& points = read.file.points;
  ASSERT_EQ(points.size(), 3U);
  EXPECT_EQ(points.position[0], glm::dvec3(4000000.001 + 1.0, 4900000.002, 100.0));
  EXPECT_EQ(points.position[2], glm::dvec3(4000010.0, 4900001.0, 100.5)) << "row vectors times the transform";
  EXPECT_EQ(points.station, (std::vector<std::uint16_t>{0, 0, 1}));
  ASSERT_EQ(points.stations.size(), 2U);
  EXPECT_EQ(points.stations[0].sensor_world, glm::dvec3(4000000.001, 4900000.002, 100.0));
  EXPECT_EQ(points.stored_color_most, 255);
  EXPECT_EQ(points.stored_color[0], glm::u16vec3(255, 0, 10));
  EXPECT_EQ(points.stored_color[2], glm::u16vec3(65535)) << "white where a scan has no colours";
}

TEST(Ptx, HeadersThatSayNothingTrueGiveTheLinesThereAre) {
  const TempFolder folder;
  std::string text = "4444\n10014\n0 0 0\n0 0 0\n0 0 0\n0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n" + CELLS;
  const auto file = folder.write("a.ptx", text);
  const ReadScan read = read_scan(file);
  EXPECT_EQ(read.file.points.size(), 5U);
  EXPECT_EQ(read.file.counts.stored, 4444ULL * 10014ULL);
  EXPECT_EQ(read.file.counts.missing, 4444ULL * 10014ULL - 6U);
  EXPECT_TRUE(read.file.points.grid_cell.empty());
  EXPECT_EQ(read.file.points.stations.at(0).rows, 0U);
  EXPECT_FALSE(read.file.points.stations[0].sensor_world) << "axes that are all zero were never filled in";
  EXPECT_TRUE(read.has_note("without a grid"));
  EXPECT_NE(strict_error(file).find("found 6 points, expected 44502216"), std::string::npos);
}

TEST(Ptx, SensorsFarFromTheirPointsAreNone) {
  const TempFolder folder;
  const ReadScan read =
      read_scan(folder.write("a.ptx", header(1, 2, "0 0 0") + "637012 849028 431 0\n637013 849030 432 0\n"));
  EXPECT_FALSE(read.file.points.stations.at(0).sensor_world);
  const auto sensor = [&](const std::string& position, const std::string& origin) {
    std::string text = header(1, 2, origin) + "1 0 0 0\n0 1 0 0\n";
    text.replace(4, origin.size(), position);
    return read_scan(folder.write("b.ptx", text)).file.points.stations.at(0).sensor_world;
  };
  EXPECT_EQ(sensor("0 0 9", "0 0 9"), glm::dvec3(0.0, 0.0, 9.0)) << "something small, seen from afar";
  EXPECT_EQ(sensor("0 0 9", "0 0 0"), glm::dvec3(0.0, 0.0, 9.0)) << "points that are in the world already";
  EXPECT_FALSE(sensor("0 0 99", "0 0 0"));
}

TEST(Ptx, TransformsWithThePositionInTheirLastColumnAreTransposed) {
  const TempFolder folder;
  const ReadScan read = read_scan(
      folder.write("a.ptx", "1\n1\n5 6 7\n" + AXES + "1 0 0 5\n0 1 0 6\n0 0 1 7\n0 0 0 1\n1 2 3 0\n"));
  EXPECT_EQ(read.file.points.position.at(0), glm::dvec3(6.0, 8.0, 10.0));
  EXPECT_TRUE(read.has_note("transposed"));
}

TEST(Ptx, WhatACutHasLeftIsReadAndCounted) {
  const TempFolder folder;
  const std::string text = header(2, 3, "0 0 0") + CELLS;
  const auto file =
      folder.write("a.ptx", text.substr(0, text.find("2 0 2 0.6") + 8));  // "2 0 2 0." of the last
  EXPECT_EQ(read_scan(file).file.counts.missing, 0U) << "six numbers of six";
  const auto cut = folder.write("b.ptx", text.substr(0, text.find("2 0 1 0.5") + 8));
  const ReadScan read = read_scan(cut);
  EXPECT_EQ(read.file.points.size(), 3U) << "the line without an end may have lost digits";
  EXPECT_EQ(read.file.counts.missing, 2U);
  EXPECT_NE(strict_error(cut).find("found 4 points, expected 6"), std::string::npos);
  EXPECT_NE(read_error(folder.write("c.ptx", "4\n3\n0 0 0\n")).find("line 3: the file ends here"),
            std::string::npos);
}

TEST(Ptx, ErrorsNameTheLine) {
  const TempFolder folder;
  const auto error = [&](std::string text, const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
    return read_error(folder.write("e.ptx", text));
  };
  const std::string good = header(2, 3, "0 0 0") + CELLS;
  EXPECT_NE(error(good, "1 0 2 0.3", "1 0 x 0.3").find("line 13: found 'x', expected a number"),
            std::string::npos);
  EXPECT_NE(error(good, "1 0 2 0.3", "1 0 2 0.3 5").find("line 13: found 5 numbers"), std::string::npos);
  EXPECT_NE(error(good, "2\n3\n", "2\n3.5\n").find("line 2: found 3.5"), std::string::npos);
  EXPECT_NE(error(good, "2\n3\n", "99999999999\n3\n").find("line 1: found 99999999999"), std::string::npos);
  EXPECT_NE(error(good, "2\n3\n0 0 0\n", "2\n3\n0 nan 0\n").find("line 3: found a number that is not finite"),
            std::string::npos);
  EXPECT_NE(error(good, "0 0 0\n1 0 0\n", "0 0\n1 0 0\n").find("line 3: found 2 numbers, expected 3"),
            std::string::npos);
}

TEST(Ptx, EveryPrefixIsAnErrorOrAValidInput) {
  const TempFolder folder;
  read_every_prefix(folder, "p.ptx",
                    header(2, 3, "0 0 0") + CELLS + header(1, 1, "5 5 5") + "1 1 1 1 1 1 1\n");
}

}  // namespace
}  // namespace splatray
