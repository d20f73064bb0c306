/// PTS and the two formats that share its extension, and how all text is read.
#include <bit>
#include <cstdlib>
#include <random>

#include "preprocess/read/text/parse_number.h"
#include "preprocess/read/text/row_reader.h"
#include "tests/readers/scan_reading.h"

namespace splatray {
namespace {

TEST(Pts, CountsMayBeRightWrongMissingOrRepeated) {
  const TempFolder folder;
  const std::string lines = "1 2 3 -2048 10 20 30\n4 5 6 2047 255 0 128\n";
  const auto read = [&](const std::string& text) { return read_scan(folder.write("a.pts", text)); };
  for (const std::string count : {"2\n", "", "1\n"}) {
    const ReadScan scan = read(count + lines);
    EXPECT_EQ(scan.file.points.size(), 2U) << count;
    EXPECT_EQ(scan.file.counts.stored, 2U);
    EXPECT_EQ(scan.file.counts.missing, 0U);
    EXPECT_EQ(scan.has_note("line 1 says 1 points, and 2 follow"), count == "1\n");
    EXPECT_EQ(scan.file.points.stored_color[1], glm::u16vec3(255, 0, 128));
    EXPECT_EQ(find_column(scan.file.points.columns, COLUMN_INTENSITY)->number(0), -2048.0);
  }
  const ReadScan blocks = read("2\n" + lines + "3\n7 8 9 5\n1 1 1 6\n");
  EXPECT_EQ(blocks.file.points.size(), 4U) << "the second block has fewer columns";
  EXPECT_EQ(blocks.file.counts.stored, 5U);
  EXPECT_EQ(blocks.file.counts.missing, 1U);
  EXPECT_EQ(blocks.file.points.stored_color[3], glm::u16vec3(65535)) << "white: 8 bits are clamped to 255";
  EXPECT_NE(strict_error(folder.write("s.pts", "3\n" + lines)).find("found 2 points, expected 3"),
            std::string::npos);
}

TEST(Pts, IntensityIsBehindColoursWhereNoCountSaysOtherwise) {
  const TempFolder folder;
  const std::string lines = "1 2 3 10 20 30 0.25\n4 5 6 255 0 128 0.5\n";
  const ReadScan last = read_scan(folder.write("a.pts", lines));
  EXPECT_EQ(last.file.points.stored_color.at(0), glm::u16vec3(10, 20, 30));
  EXPECT_EQ(find_column(last.file.points.columns, COLUMN_INTENSITY)->number(0), 0.25);
  EXPECT_TRUE(last.has_note("column 7 is taken as the intensity"));
  const ReadScan counted = read_scan(folder.write("b.pts", "2\n" + lines));
  EXPECT_EQ(find_column(counted.file.points.columns, COLUMN_INTENSITY)->number(0), 10.0);
  EXPECT_FALSE(counted.has_note("column 7"));
}

TEST(Pts, TextIsReadAsDouble) {
  const TempFolder folder;
  const ReadScan read = read_scan(folder.write("a.pts", "1\n4321234.123 +5512345.678 -1e2\n"));
  EXPECT_EQ(read.file.points.position.at(0), glm::dvec3(4321234.123, 5512345.678, -100.0));
}

TEST(Pts, NormalsAndPointsWithoutAPosition) {
  const TempFolder folder;
  const ReadScan read = read_scan(
      folder.write("a.pts", "1 2 3 0 1 2 3 0 0 1\nnan nan nan 0 1 2 3 0 0 1\n1 2 3 0 1 2 3 -1.#IND 0 0\n"));
  EXPECT_EQ(read.file.points.size(), 2U);
  EXPECT_EQ(read.file.counts.no_return, 1U);
  EXPECT_EQ(read.file.points.normal.at(0), glm::vec3(0.0F, 0.0F, 1.0F));
}

TEST(Pts, ErrorsNameTheLine) {
  const TempFolder folder;
  const auto error = [&](const std::string& text) { return read_error(folder.write("e.pts", text)); };
  EXPECT_NE(error("# points\n\n2\n1 2 3\n1 2 z3\n1 2 3\n").find("line 5: found 'z3', expected a number"),
            std::string::npos);
  EXPECT_NE(error("1 2 3 4 5\n").find("line 1: found 5 numbers"), std::string::npos);
  EXPECT_NE(error("1.5\n1 2 3\n").find("line 1: found one number"), std::string::npos);
}

std::string expe_points(int count) {
  std::string text =
      "[Expe/PointSet/Binary/0.1]\nproperty position 12\nproperty radius 4\nproperty normal 12\nproperty "
      "color 4\n"
      "nofpoints " +
      std::to_string(count) + "\ndata\n";
  for (const float v : {1.0F, 2.0F, 3.0F, 0.25F, 0.0F, 1.0F, 0.0F}) text += bytes_of(v);
  return text + "\xFF\x80\x01\xFF";
}

TEST(Pts, ExpePointSets) {
  const TempFolder folder;
  const ReadScan read = read_scan(folder.write("a.pts", expe_points(1)));
  EXPECT_EQ(read.file.points.position.at(0), glm::dvec3(1.0, 2.0, 3.0));
  EXPECT_EQ(read.file.points.radius.at(0), 0.25F);
  EXPECT_EQ(read.file.points.normal.at(0), glm::vec3(0.0F, 1.0F, 0.0F));
  EXPECT_EQ(read.file.points.stored_color.at(0), glm::u16vec3(255, 128, 1));
  const auto cut = folder.write("b.pts", expe_points(2000000000));
  EXPECT_EQ(read_scan(cut).file.counts.missing, 1999999999U);
  EXPECT_NE(strict_error(cut).find("found 1 points"), std::string::npos);
  read_every_prefix(folder, "p.pts", expe_points(1));
}

TEST(ParseNumber, IsTheNearestDouble) {
  std::mt19937_64 random(1);
  const auto below = [&](std::uint64_t most) { return random() % most; };
  std::size_t through_short = 0;
  for (int i = 0; i < 200000; ++i) {
    std::string text = below(2) == 0 ? "-" : "";
    for (std::uint64_t digits = below(12); digits > 0; --digits) text += static_cast<char>('0' + below(10));
    if (below(3) > 0) text += ".";
    for (std::uint64_t digits = below(8); digits > 0; --digits) text += static_cast<char>('0' + below(10));
    if (below(10) == 0) text += "e" + std::to_string(static_cast<int>(below(40)) - 20);
    const char* const end = text.data() + text.size();
    double value = -7.0;
    double quick = -7.0;
    char* expected_end = nullptr;
    const double expected = std::strtod(text.c_str(), &expected_end);
    const char* const rest = parse_number(text.data(), end, value);
    ASSERT_EQ(rest == end, expected_end == end && !text.empty()) << text;
    if (rest != end) continue;
    ASSERT_EQ(std::bit_cast<std::uint64_t>(value), std::bit_cast<std::uint64_t>(expected)) << text;
    through_short += parse_short_number(text.data(), end, quick) == end ? 1 : 0;
  }
  EXPECT_GT(through_short, 100000U);
}

/// More than one block and many pieces; a comment and an empty line among them.
TEST(RowReader, BlocksAndPiecesKeepLinesAndTheirNumbers) {
  constexpr std::uint64_t LINES = 900000;
  const TempFolder folder;
  std::string text = "# first\n\n";
  for (std::uint64_t i = 0; i < LINES; ++i)
    text += std::to_string(i) + (i % 2 == 0 ? " 0.5 7\n" : "\t0.5   7 \r\n");
  const auto file = folder.write("a.pts", text);
  ASSERT_GT(text.size(), 2 * LineBlocks::BLOCK_BYTES);
  std::vector<std::string> notes;
  const Progress none;
  const ReadListener listener{notes, none};
  RowReader rows(file, listener, {});
  std::uint64_t expected = 0;
  std::uint64_t wrong = 0;
  for (RowRun run; rows.next(run);) {
    ASSERT_EQ(run.width, 3U);
    for (std::size_t i = 0; i < run.rows; ++i, ++expected)
      wrong += run.row(i)[0] != static_cast<double>(expected) || run.first_line + i != expected + 3 ? 1 : 0;
  }
  EXPECT_EQ(wrong, 0U);
  EXPECT_EQ(expected, LINES);
  text += "1 2 oops\n";
  EXPECT_NE(read_error(folder.write("b.pts", text)).find("line 900003: found 'oops'"), std::string::npos);
}

TEST(RowReader, LinesBeyondABlockAreRefused) {
  const TempFolder folder;
  EXPECT_NE(read_error(folder.write("a.pts", std::string(LineBlocks::BLOCK_BYTES + 5000000, '1')))
                .find("found a line of more"),
            std::string::npos);
}

}  // namespace
}  // namespace splatray
