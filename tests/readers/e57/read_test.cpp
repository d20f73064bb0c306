/// What E57 files hold comes out of the reader (preprocess/read/e57).
#include <cmath>
#include <numbers>
#include <random>

#include "preprocess/read/e57/crc32c.h"
#include "preprocess/read/e57/scan_sensor.h"
#include "tests/readers/e57/read_bytes.h"

namespace splatray {
namespace {

using testing::counted;
using testing::e57_bytes;
using testing::e57_pose;
using testing::E57TestField;
using testing::E57TestFile;
using testing::E57TestScan;
using testing::line_scan;
using testing::read_bytes;

TEST(E57, ChecksumIsCrc32C) {
  const std::string digits = "123456789";
  EXPECT_EQ(crc32c(reinterpret_cast<const unsigned char*>(digits.data()), digits.size()), 0xE3069283U);
  const std::string zeros(32, '\0');
  EXPECT_EQ(crc32c(reinterpret_cast<const unsigned char*>(zeros.data()), zeros.size()), 0x8A9136AAU)
      << "RFC 3720, appendix B.4";
}

TEST(E57, CoordinateSystemIsKept) {
  E57TestFile file{{line_scan(3)}};
  EXPECT_EQ(read_bytes(e57_bytes(file)).points.crs, "");
  file.elements =
      "<coordinateMetadata type=\"String\"><![CDATA[ PROJCS[\"UTM\",UNIT[\"metre\",1]] "
      "]]></coordinateMetadata>";
  EXPECT_EQ(read_bytes(e57_bytes(file)).points.crs, "PROJCS[\"UTM\",UNIT[\"metre\",1]]");
}

TEST(E57, EveryBitWidthAcrossPacketBorders) {
  std::mt19937_64 random(1);
  constexpr int COUNT = 150;
  for (unsigned bits = 1; bits <= 64; ++bits) {
    const auto minimum = static_cast<std::int64_t>(0 - (std::uint64_t{1} << (bits - 1)));
    const auto maximum = static_cast<std::int64_t>((std::uint64_t{1} << (bits - 1)) - 1);
    std::vector<std::int64_t> values{minimum, maximum};
    while (values.size() < COUNT)
      values.push_back(static_cast<std::int64_t>(random() << (64 - bits)) >> (64 - bits));
    for (const std::size_t packet_bytes : {1UL, 7UL, 4000UL}) {
      E57TestScan scan;
      scan.packet_bytes = packet_bytes;
      scan.fields = {E57TestField::scaled("cartesianX", minimum, maximum, 0.001, 3.0, values),
                     E57TestField::integer("cartesianY", 5, 5, std::vector<std::int64_t>(COUNT, 5)),
                     E57TestField::integer("cartesianZ", -2, 1, std::vector<std::int64_t>(COUNT, -1))};
      ASSERT_EQ(scan.fields[0].bits, bits);
      const Points points = read_bytes(e57_bytes(scan)).points;
      ASSERT_EQ(points.size(), values.size()) << bits << " bits";
      for (std::size_t i = 0; i < values.size(); ++i)
        ASSERT_EQ(points.position[i], glm::dvec3(static_cast<double>(values[i]) * 0.001 + 3.0, 5.0, -1.0))
            << bits << " bits in packets of " << packet_bytes << " bytes, value " << i;
    }
  }
}

TEST(E57, PacketsOfAnySizeAndKindGiveTheSame) {
  E57TestScan scan = line_scan(5000);
  scan.fields[1] = E57TestField::float32("cartesianY", std::vector<float>(5000, 0.1F));
  scan.fields.push_back(E57TestField::integer("intensity", 0, 5000, counted(5000)));
  const Points expected = read_bytes(e57_bytes(scan)).points;
  ASSERT_EQ(expected.size(), 5000U);
  EXPECT_EQ(expected.position[4999], glm::dvec3(5000.0, double{0.1F}, -4999.0));
  for (const std::size_t packet_bytes : {1UL, 3UL, 1021UL, 16000UL}) {
    scan.packet_bytes = packet_bytes;
    scan.has_other_packets = true;
    const Points points = read_bytes(e57_bytes(scan)).points;
    EXPECT_EQ(points.position, expected.position) << packet_bytes;
    EXPECT_EQ(points.columns.at(0).values, expected.columns.at(0).values) << packet_bytes;
  }
}

TEST(E57, PosesTurnAndShiftPositionsAndNormals) {
  const double half = std::sqrt(0.5);
  E57TestScan scan = line_scan(1);
  scan.fields.push_back(E57TestField::float32("nor:normalX", {0.0F}));
  scan.fields.push_back(E57TestField::float32("nor:normalY", {1.0F}));
  scan.fields.push_back(E57TestField::float32("nor:normalZ", {0.0F}));
  const auto read = [&](const std::vector<double>& rotation) {
    scan.xml = e57_pose(rotation, {500000.0, 4.0e6, 0.125});
    E57TestFile file{{scan}};
    file.namespaces = " xmlns:nor=\"http://www.libe57.org/E57_NOR_surface_normals.txt\"";
    return read_bytes(e57_bytes(file)).points;
  };
  for (const double length : {1.0, 7.0}) {
    const Points turned = read({length * half, 0.0, 0.0, length * half});
    EXPECT_NEAR(glm::distance(turned.position[0], glm::dvec3(500000.0, 4.0e6 + 1.0, 0.125)), 0.0, 1e-9);
    EXPECT_NEAR(glm::distance(turned.normal.at(0), glm::vec3(-1.0F, 0.0F, 0.0F)), 0.0, 1e-6);
  }
  for (const std::vector<double>& none : {std::vector<double>{0.0, 0.0, 0.0, 0.0}, std::vector<double>{}}) {
    const Points shifted = read(none);
    EXPECT_EQ(shifted.position[0], glm::dvec3(500001.0, 4.0e6, 0.125));
    EXPECT_EQ(shifted.normal.at(0), glm::vec3(0.0F, 1.0F, 0.0F));
  }
}

TEST(E57, NormalsAreFoundByTheirNamespaceNotItsPrefix) {
  E57TestScan scan = line_scan(2);
  for (const char* axis : {"X", "Y", "Z"})
    scan.fields.push_back(E57TestField::float32(std::string("n:normal") + axis, {0.5F, 0.25F}));
  scan.fields.push_back(E57TestField::float32("ext:intensity", {7.0F, 7.0F}));
  E57TestFile file{{scan}};
  const std::string other = " xmlns:ext=\"http://example.com/extension\"";
  file.namespaces = " xmlns:n=\"http://www.libe57.org/E57_NOR_surface_normals.txt\"" + other;
  const Points points = read_bytes(e57_bytes(file)).points;
  ASSERT_EQ(points.normal.size(), 2U);
  EXPECT_EQ(points.normal[1], glm::vec3(0.25F));
  EXPECT_TRUE(points.columns.empty()) << "another's intensity";
  file.namespaces = " xmlns:n=\"http://example.com/n\"" + other;
  EXPECT_TRUE(read_bytes(e57_bytes(file)).points.normal.empty()) << "another's normals";
}

TEST(E57, StandardNamesMayHaveAPrefix) {
  E57TestScan scan = line_scan(2);
  for (E57TestField& field : scan.fields) field.name = "e:" + field.name;
  E57TestFile file{{scan}};
  file.namespaces = " xmlns:e=\"http://www.astm.org/COMMIT/E57/2010-e57-v1.0\"";
  EXPECT_EQ(read_bytes(e57_bytes(file)).points.position[1], glm::dvec3(2.0, 2.0, -1.0));
}

TEST(E57, InvalidStatesOfAnyTypeDropTheirPoints) {
  const std::vector<E57TestField> states = {
      E57TestField::integer("cartesianInvalidState", 0, 2, {0, 1, 2, 0}),
      E57TestField::scaled("cartesianInvalidState", 0, 2, 1.0, 0.0, {0, 1, 2, 0}),
      E57TestField::float32("cartesianInvalidState", {0.0F, 1.0F, 2.0F, 0.0F}),
      E57TestField::float64("cartesianInvalidState", {0.0, 1.0, 2.0, 0.0})};
  for (const E57TestField& state : states) {
    E57TestScan scan = line_scan(4);
    scan.fields.push_back(state);
    scan.fields.push_back(E57TestField::integer("intensity", 0, 9, {6, 7, 8, 9}));
    const ScanFile file = read_bytes(e57_bytes(scan));
    EXPECT_EQ(file.points.position, (std::vector<glm::dvec3>{{1.0, 0.0, 0.0}, {4.0, 6.0, -3.0}}));
    EXPECT_EQ(file.counts.stored, 4U);
    EXPECT_EQ(file.counts.no_return, 2U);
    EXPECT_EQ(file.points.columns.at(0).number(1), 9.0);
  }
}

TEST(E57, CoordinatesThatAreNoNumbersAreNoReturns) {
  E57TestScan scan = line_scan(3);
  scan.fields[1] = E57TestField::float64("cartesianY", {NAN, INFINITY, 1.0});
  const ScanFile file = read_bytes(e57_bytes(scan));
  EXPECT_EQ(file.points.size(), 1U);
  EXPECT_EQ(file.counts.no_return, 2U);
}

TEST(E57, SphericalCoordinatesWithAzimuthsBeyondPi) {
  const double pi = std::numbers::pi;
  E57TestScan scan;
  scan.fields = {E57TestField::float64("sphericalRange", {2.0, 2.0, 2.0, 1.0}),
                 E57TestField::float64("sphericalAzimuth", {0.0, 1.5 * pi, -3.0 * pi, 0.0}),
                 E57TestField::float64("sphericalElevation", {pi / 2.0, 0.0, 0.0, 0.0}),
                 E57TestField::integer("sphericalInvalidState", 0, 2, {0, 0, 0, 1})};
  const Points points = read_bytes(e57_bytes(scan)).points;
  const std::vector<glm::dvec3> expected{{0.0, 0.0, 2.0}, {0.0, -2.0, 0.0}, {-2.0, 0.0, 0.0}};
  ASSERT_EQ(points.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(glm::distance(points.position[i], expected[i]), 0.0, 1e-12);
  EXPECT_EQ(points.stations.at(0).sensor_world, glm::dvec3(0.0)) << "spherical ones are about the scanner";
}

TEST(E57, NamesAreTextsOfAnyLanguageOrBlank) {
  const auto name_of = [](const std::string& text) {
    E57TestScan scan = line_scan(1);
    scan.xml = "<name type=\"String\">" + text + "</name>";
    return read_bytes(e57_bytes(scan)).points.stations.at(0).name;
  };
  EXPECT_EQ(name_of("<![CDATA[Küche & 客厅]]>"), "Küche & 客厅");
  EXPECT_EQ(name_of("a &amp; b"), "a & b");
  EXPECT_EQ(name_of(" \n\t "), "");
  EXPECT_EQ(name_of(""), "");
}

TEST(E57, ScansOfOneFileAreItsStations) {
  E57TestFile file;
  file.scans = {line_scan(2), line_scan(0), line_scan(3)};
  file.scans[2].xml = "<name type=\"String\">last</name>";
  file.scans[2].fields.push_back(E57TestField::integer("intensity", 0, 9, {7, 8, 9}));
  for (const char* name : {"colorRed", "colorGreen", "colorBlue"})
    file.scans[0].fields.push_back(E57TestField::integer(name, 0, 255, {1, 2}));
  file.images = "<vectorChild type=\"Structure\"><guid type=\"String\">i</guid></vectorChild>";
  const ScanFile read = read_bytes(e57_bytes(file));
  const Points& points = read.points;
  EXPECT_EQ(read.counts.stored, 5U);
  ASSERT_EQ(points.stations.size(), 3U);
  EXPECT_EQ(points.stations[2].name, "last");
  EXPECT_EQ(points.station, (std::vector<std::uint16_t>{0, 0, 2, 2, 2}));
  EXPECT_EQ(points.columns.at(0).values, (decltype(Column::values)(Pool<float>{0, 0, 7, 8, 9})));
  EXPECT_EQ(points.stored_color.at(1), glm::u16vec3(2));
  EXPECT_EQ(points.stored_color.at(4), glm::u16vec3(255));
}

TEST(E57, EmptyScansAndNoScansAreNoErrors) {
  EXPECT_EQ(read_bytes(e57_bytes(line_scan(0))).points.stations.size(), 1U);
  EXPECT_EQ(read_bytes(e57_bytes(E57TestFile{})).points.size(), 0U);
}

TEST(E57, RecordsWithoutBitsAreAllThere) {
  E57TestScan scan;
  for (const char* name : {"cartesianX", "cartesianY", "cartesianZ"})
    scan.fields.push_back(E57TestField::integer(name, 4, 4, {4, 4, 4}));
  EXPECT_EQ(read_bytes(e57_bytes(scan)).points.position, std::vector<glm::dvec3>(3, glm::dvec3(4.0)));
}

TEST(E57, FilesBeyondFourGibibytes) {
  E57TestFile file{{line_scan(100)}};
  file.hole = (std::uint64_t{5} << 30U) / 1024;
  const std::string bytes = e57_bytes(file);
  const TempFolder folder;
  const std::filesystem::path path = folder.write("far.e57", bytes.substr(0, 1024));
  {
    std::ofstream far(path, std::ios::binary | std::ios::in);
    far.seekp(static_cast<std::streamoff>((file.hole + 1) * 1024));
    far << bytes.substr(1024);
  }
  std::vector<std::string> notes;
  const ReadOptions options;
  const Points points = read_e57(path, options, {notes, options.progress}).points;
  ASSERT_EQ(points.size(), 100U);
  EXPECT_EQ(points.position[99], glm::dvec3(100.0, 198.0, -99.0));
}

/// Of a scan with this pose and a box of points from `low` to `high`.
bool is_sensor(bool measured_around, const glm::dquat& rotation, const glm::dvec3& translation,
               const glm::dvec3& low, const glm::dvec3& high, bool shifted_alone = false) {
  E57Scan scan;
  scan.is_shifted_alone = shifted_alone;
  scan.rotation = rotation;
  scan.translation = translation;
  ScanBox box;
  box.add(low);
  box.add(high);
  return is_sensor_at_origin(scan, measured_around, box);
}

TEST(E57, TheScannersPlaceIsOnlyBelievedWhereItIsCredible) {
  const glm::dquat turned(0.6, 0.0, 0.0, 0.8);
  const glm::dquat straight(1.0, 0.0, 0.0, 0.0);
  const glm::dvec3 moved(9.0, 8.0, 7.0);
  const glm::dvec3 low(-1.0);
  const glm::dvec3 high(1.0);
  const glm::dvec3 map(494000.0, 4877000.0, 120.0);
  EXPECT_TRUE(is_sensor(true, straight, glm::dvec3(0.0), low, high)) << "a grid about the scanner";
  EXPECT_TRUE(is_sensor(false, turned, moved, low, high));
  EXPECT_TRUE(is_sensor(false, straight, moved, low, high)) << "shifted, the scanner amid its points";
  EXPECT_FALSE(is_sensor(false, straight, glm::dvec3(0.0), low, high)) << "nothing shows a scanner's frame";
  EXPECT_FALSE(is_sensor(false, straight, moved, low + 2.0, high + 2.0))
      << "large coordinates that were shifted";
  EXPECT_TRUE(is_sensor(false, straight, moved, low + 2.0, high + 2.0, true))
      << "as no other scan of the file";
  EXPECT_FALSE(is_sensor(false, straight, moved, low + 9.0, high + 9.0, true))
      << "tiles of large coordinates";
  EXPECT_TRUE(is_sensor(true, turned, moved, low + 12.0, high + 12.0)) << "an object seen from afar";
  EXPECT_FALSE(is_sensor(true, turned, moved, low + map, high + map)) << "a grid in map coordinates";
  EXPECT_FALSE(is_sensor_at_origin({}, true, {})) << "no points";
}

TEST(E57, ReadingReportsItsShareAndCanBeStopped) {
  const TempFolder folder;
  E57TestFile file{{line_scan(2000), line_scan(2000)}};
  file.scans[0].packet_bytes = file.scans[1].packet_bytes = 100;
  const std::filesystem::path path = folder.write("a.e57", e57_bytes(file));
  std::vector<double> shares;
  ReadOptions options;
  options.progress = [&](std::string_view, double share) {
    shares.push_back(share);
    return true;
  };
  std::vector<std::string> notes;
  static_cast<void>(read_e57(path, options, {notes, options.progress}));
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_GT(shares.size(), 10U);
  EXPECT_LE(shares.back(), 1.0);
  options.progress = [](std::string_view, double share) { return share < 0.6; };
  try {
    static_cast<void>(read_e57(path, options, {notes, options.progress}));
    ADD_FAILURE() << "expected an interruption";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::interrupted);
  }
}

}  // namespace
}  // namespace splatray
