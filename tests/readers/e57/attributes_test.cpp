/// Attributes of E57's points: grids, colours, intensity, and which points are none.
#include "tests/readers/e57/read_bytes.h"

namespace splatray {
namespace {

using testing::counted;
using testing::e57_bytes;
using testing::e57_pose;
using testing::E57TestField;
using testing::E57TestScan;
using testing::line_scan;
using testing::read_bytes;

/// A posed scan of `count` points, of which the first `origins` lie in the origin, with all attributes.
E57TestScan scan_with_origins(int count, int origins) {
  E57TestScan scan = line_scan(count);
  for (E57TestField& field : scan.fields)
    for (int i = 0; i < origins; ++i) field.packed[static_cast<std::size_t>(i)] = 0;
  scan.xml = e57_pose({}, {10.0, 20.0, 30.0});
  for (const char* name : {"colorRed", "colorGreen", "colorBlue"}) {
    std::vector<std::int64_t> values = counted(count);
    for (std::int64_t& value : values) value %= 256;
    scan.fields.push_back(E57TestField::integer(name, 0, 255, values));
  }
  scan.fields.push_back(E57TestField::integer("intensity", 0, count, counted(count)));
  scan.fields.push_back(E57TestField::integer("rowIndex", 0, count, counted(count)));
  scan.fields.push_back(E57TestField::integer("columnIndex", 0, 1, [&] {
    std::vector<std::int64_t> columns(static_cast<std::size_t>(count), 0);
    columns.back() = 1;
    return columns;
  }()));
  return scan;
}

TEST(E57Attributes, ManyPointsAtTheScannersPlaceAreNoReturns) {
  const ScanFile many = read_bytes(e57_bytes(scan_with_origins(100, 11)));
  EXPECT_EQ(many.points.size(), 89U);
  EXPECT_EQ(many.counts.no_return, 11U);
  EXPECT_EQ(many.points.position[0], glm::dvec3(22.0, 42.0, 19.0));
  EXPECT_EQ(many.points.columns.at(0).size(), 89U);
  EXPECT_EQ(many.points.columns.at(0).number(0), 11.0) << "attributes stay beside their points";
  EXPECT_EQ(many.points.grid_cell.at(0), 22U);
  EXPECT_EQ(many.points.grid_cell.size(), 89U);
  EXPECT_EQ(many.points.stored_color.size(), 89U);
  EXPECT_EQ(many.points.stored_color.at(0), glm::u16vec3(11));
  EXPECT_EQ(read_bytes(e57_bytes(scan_with_origins(100, 10))).points.size(), 100U) << "few may be points";
  EXPECT_EQ(read_bytes(e57_bytes(scan_with_origins(12000, 11))).points.size(), 12000U) << "a small share too";
}

TEST(E57Attributes, RowsAndColumnsAreTheStationsGrid) {
  E57TestScan scan = line_scan(6);
  scan.fields.push_back(E57TestField::integer("rowIndex", 0, 9, {0, 0, 1, 1, 2, 2}));
  scan.fields.push_back(E57TestField::integer("columnIndex", 0, 9, {0, 3, 0, 3, 1, 2}));
  const Points points = read_bytes(e57_bytes(scan)).points;
  EXPECT_EQ(points.stations.at(0).rows, 3U);
  EXPECT_EQ(points.stations.at(0).columns, 4U);
  EXPECT_EQ(points.grid_cell, (std::vector<std::uint32_t>{0, 3, 4, 7, 9, 10}));
  scan.xml =
      "<indexBounds type=\"Structure\"><rowMaximum type=\"Integer\">3</rowMaximum>"
      "<columnMaximum type=\"Integer\">5</columnMaximum></indexBounds>";
  const Points bounded = read_bytes(e57_bytes(scan)).points;
  EXPECT_EQ(bounded.stations.at(0).rows, 4U) << "rows without a point count too";
  EXPECT_EQ(bounded.stations.at(0).columns, 6U);
  EXPECT_EQ(bounded.grid_cell.at(5), 14U);
  scan.xml =
      "<indexBounds type=\"Structure\"><rowMaximum type=\"Integer\">4000000000</rowMaximum>"
      "<columnMaximum type=\"Integer\">4000000000</columnMaximum></indexBounds>";
  EXPECT_EQ(read_bytes(e57_bytes(scan)).points.grid_cell, points.grid_cell)
      << "bounds that no record reaches";
}

TEST(E57Attributes, GridsThatAreNoneAreNotUsed) {
  E57TestScan scan = line_scan(3);
  scan.fields.push_back(E57TestField::integer("rowIndex", 0, 4000000000, {0, 1, 4000000000}));
  scan.fields.push_back(E57TestField::integer("columnIndex", 0, 4000000000, {0, 1, 4000000000}));
  const Points far = read_bytes(e57_bytes(scan), 1).points;
  EXPECT_TRUE(far.grid_cell.empty());
  EXPECT_EQ(far.stations.at(0).rows, 0U);
  scan.fields[3] = E57TestField::integer("rowIndex", 0, 0, {0, 0, 0});
  EXPECT_TRUE(read_bytes(e57_bytes(scan)).points.grid_cell.empty()) << "one row is no grid";
  testing::E57TestFile file{{line_scan(2), scan, line_scan(1), scan}};
  EXPECT_TRUE(read_bytes(e57_bytes(file)).points.grid_cell.empty());
  file.scans[3].fields[3] = E57TestField::integer("rowIndex", 0, 1, {0, 1, 1});
  file.scans[3].fields[4] = E57TestField::integer("columnIndex", 0, 1, {0, 0, 1});
  EXPECT_EQ(read_bytes(e57_bytes(file)).points.grid_cell,
            (std::vector<std::uint32_t>{NO_CELL, NO_CELL, NO_CELL, NO_CELL, NO_CELL, NO_CELL, 0, 2, 3}));
}

std::vector<glm::u16vec3> colors_of(const std::vector<E57TestField>& channels, const std::string& xml = "") {
  E57TestScan scan = line_scan(3);
  scan.xml = xml;
  scan.fields.insert(scan.fields.end(), channels.begin(), channels.end());
  const Points points = read_bytes(e57_bytes(scan)).points;
  EXPECT_EQ(points.stored_color_most, 255U);
  return points.stored_color;
}

template <class Make>
std::vector<E57TestField> channels(const Make& make) {
  return {make("colorRed"), make("colorGreen"), make("colorBlue")};
}

std::string limits(const std::string& low, const std::string& high) {
  std::string xml = "<colorLimits type=\"Structure\">";
  for (const char* name : {"colorRed", "colorGreen", "colorBlue"})
    for (const auto& [end, value] : {std::pair{"Minimum", low}, std::pair{"Maximum", high}})
      xml += std::string("<") + name + end + " type=\"Float\">" + value + "</" + name + end + ">";
  return xml + "</colorLimits>";
}

TEST(E57Attributes, ColoursAreScaledByTheirLimits) {
  const std::vector<glm::u16vec3> grey{glm::u16vec3(0), glm::u16vec3(51), glm::u16vec3(255)};
  const auto bytes = channels([](const char* name) {
    return E57TestField::integer(name, 0, 255, {0, 51, 255});
  });
  const auto words = channels([](const char* name) {
    return E57TestField::integer(name, 0, 65535, {0, 13107, 65535});
  });
  const auto floats = channels([](const char* name) {
    return E57TestField::float32(name, {0.0F, 0.2F, 1.0F});
  });
  EXPECT_EQ(colors_of(bytes), grey);
  EXPECT_EQ(colors_of(bytes, limits("0", "255")), grey);
  EXPECT_EQ(colors_of(words), grey) << "by the field's range";
  EXPECT_EQ(colors_of(words, limits("0", "65535")), grey);
  EXPECT_EQ(colors_of(words, limits("0", "0")), grey) << "limits that are none";
  EXPECT_EQ(colors_of(floats, limits("0", "1")), grey);
  EXPECT_EQ(colors_of(bytes, limits("51", "153"))[1], glm::u16vec3(0));
  EXPECT_EQ(colors_of(bytes, limits("51", "153"))[2], glm::u16vec3(255)) << "beyond the limit";
  std::string scaled = limits("0", "131070");
  for (std::size_t at = 0; (at = scaled.find("\"Float\"", at)) != std::string::npos;)
    scaled.replace(at, 7, "\"ScaledInteger\" scale=\"0.5\" offset=\"0\"");
  EXPECT_EQ(colors_of(words, scaled), grey) << "limits are numbers of any type";
  auto invalid = bytes;
  invalid.push_back(E57TestField::integer("isColorInvalid", 0, 1, {1, 0, 0}));
  EXPECT_EQ(colors_of(invalid)[0], glm::u16vec3(255)) << "white, as where there is none";
}

/// A scan of three points whose channels have these values.
E57TestScan grey_scan(const std::vector<float>& values, const std::string& xml) {
  E57TestScan scan = line_scan(3);
  scan.xml = xml;
  for (const char* name : {"colorRed", "colorGreen", "colorBlue"})
    scan.fields.push_back(E57TestField::float32(name, values));
  return scan;
}

TEST(E57Attributes, ColoursThatSpeakAgainstTheirLimitsAreScaledByTheirValues) {
  const std::vector<glm::u16vec3> grey{glm::u16vec3(0), glm::u16vec3(51), glm::u16vec3(255)};
  const auto read = [](const E57TestScan& scan) {
    return read_bytes(e57_bytes(scan), 1).points.stored_color;
  };
  EXPECT_EQ(read(grey_scan({0, 0.2F, 1}, "")), grey) << "floats without limits";
  EXPECT_EQ(read(grey_scan({0, 0.2F, 1}, limits("0", "255"))), grey);
  EXPECT_EQ(read(grey_scan({0, 51, 255}, limits("0", "1"))), grey);
  EXPECT_EQ(read(grey_scan({0, 51, 255}, limits("0", "65535"))), grey);
  EXPECT_EQ(read(grey_scan({0, 13107, 65535}, limits("0", "255"))), grey);
  EXPECT_EQ(read(grey_scan({0, 13107, 65535}, "")), grey);
  E57TestScan words = line_scan(3);
  for (const char* name : {"colorRed", "colorGreen", "colorBlue"})
    words.fields.push_back(E57TestField::integer(name, 0, 65535, {0, 51, 255}));
  EXPECT_EQ(read(words), grey) << "8 bits in fields of 16";
}

TEST(E57Attributes, ColoursOfAllScansOfOneScaleAreJudgedTogether) {
  const std::string wide = limits("0", "65535");
  const testing::E57TestFile dark{{grey_scan({0, 13107, 65535}, wide), grey_scan({257, 514, 771}, wide)}};
  const std::vector<glm::u16vec3> colors = read_bytes(e57_bytes(dark)).points.stored_color;
  EXPECT_EQ(colors.at(2), glm::u16vec3(255));
  EXPECT_EQ(colors.at(5), glm::u16vec3(3)) << "a dark room beside a bright one";
  const testing::E57TestFile mixed{{grey_scan({0, 0.2F, 1}, limits("0", "255")), line_scan(2),
                                    scan_with_origins(100, 11), grey_scan({0, 51, 255}, wide)}};
  const Points points = read_bytes(e57_bytes(mixed), 2).points;
  ASSERT_EQ(points.stored_color.size(), 97U);
  EXPECT_EQ(points.stored_color[1], glm::u16vec3(51));
  EXPECT_EQ(points.stored_color[4], glm::u16vec3(255)) << "white, as where there is none";
  EXPECT_EQ(points.stored_color[5], glm::u16vec3(11));
  EXPECT_EQ(points.stored_color[95], glm::u16vec3(51));
}

TEST(E57Attributes, ColoursThatAreAllBlackAreLeftToBeJudged) {
  EXPECT_EQ(read_bytes(e57_bytes(grey_scan({0, 0, 0}, limits("0", "1")))).points.stored_color_most, 0U);
  const TempFolder folder;
  const Input input = read_input({folder.write("a.e57", e57_bytes(grey_scan({0, 0, 0}, "")))}, {});
  EXPECT_TRUE(input.objects.at(0).points.color.empty());
  EXPECT_TRUE(has_note(input, "all black and were left out"));
}

TEST(E57Attributes, IntensityIsScaledButItsLimitsAreNotApplied) {
  E57TestScan scan = line_scan(3);
  scan.xml =
      "<intensityLimits type=\"Structure\"><intensityMinimum type=\"Integer\">0</intensityMinimum>"
      "<intensityMaximum type=\"Integer\">0</intensityMaximum></intensityLimits>";
  scan.fields.push_back(E57TestField::scaled("intensity", -666, 666, 0.1, 2.0, {-666, 666, 5}));
  scan.fields.push_back(E57TestField::integer("isIntensityInvalid", 0, 1, {0, 0, 1}));
  const Points points = read_bytes(e57_bytes(scan)).points;
  ASSERT_EQ(points.columns.size(), 1U);
  EXPECT_EQ(points.columns[0].name, COLUMN_INTENSITY);
  EXPECT_EQ(points.columns[0].values, (decltype(Column::values)(Pool<float>{-64.6F, 68.6F, 0.0F})));
}

TEST(E57Attributes, FurtherFieldsAreKeptByNameAndReturnsWhereThereAreSeveral) {
  E57TestScan scan = line_scan(2);
  scan.fields.push_back(E57TestField::float64("timeStamp", {0.25, 1e9}));
  scan.fields.push_back(E57TestField::integer("returnIndex", 0, 3, {0, 1}));
  EXPECT_TRUE(read_bytes(e57_bytes(scan)).points.columns.empty());
  scan.fields.push_back(E57TestField::integer("returnCount", 0, 3, {1, 2}));
  ReadOptions options;
  options.scans.attributes = {"timeStamp", "none"};
  const Points points = read_bytes(e57_bytes(scan), 0, options).points;
  ASSERT_EQ(points.columns.size(), 3U);
  EXPECT_EQ(find_column(points.columns, COLUMN_RETURN)->number(1), 2.0) << "counted from 1 here";
  EXPECT_EQ(find_column(points.columns, COLUMN_RETURNS)->number(0), 1.0);
  EXPECT_EQ(find_column(points.columns, "timeStamp")->number(1), 1e9);
}

TEST(E57Attributes, IntegersWithoutRangeAreLeftOutOrRefused) {
  E57TestScan scan = line_scan(2);
  scan.fields.push_back(E57TestField::integer("intensity", 0, 3, {1, 2}));
  scan.fields[3].attributes = " type=\"Integer\"";
  const Points points = read_bytes(e57_bytes(scan), 1).points;
  EXPECT_EQ(points.size(), 2U);
  EXPECT_TRUE(points.columns.empty());
  const TempFolder folder;
  scan.fields[0] = E57TestField::integer("cartesianX", 0, 3, {1, 2});
  scan.fields[0].attributes = " type=\"ScaledInteger\" scale=\"0.1\" minimum=\"0\"";
  EXPECT_NE(
      read_error(folder.write("a.e57", e57_bytes(scan))).find("cartesianX which has no minimum and maximum"),
      std::string::npos);
}

TEST(E57Attributes, TextsInRecordsArePassedOver) {
  E57TestScan scan = line_scan(2);
  scan.fields.insert(scan.fields.begin(), {"ext:note", " type=\"String\"", 8, {6, 'a', 'b', 'c', 0}});
  scan.more_records = -3;
  EXPECT_EQ(read_bytes(e57_bytes(scan)).points.position[1], glm::dvec3(2.0, 2.0, -1.0));
}

}  // namespace
}  // namespace splatray
