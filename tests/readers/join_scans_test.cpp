/// Many files of one survey are one object (preprocess/read/join_scans.h).
#include "preprocess/read/join_scans.h"

#include <gtest/gtest.h>

#include "engine/base/error.h"
#include "engine/base/srgb.h"

namespace splatray {
namespace {

InputObject joined(std::vector<NamedScan> scans) {
  std::vector<std::string> notes;
  return join_scans(std::move(scans), notes);
}

ScanFile scan_at(double x, std::size_t count) {
  ScanFile file;
  file.points.position.assign(count, glm::dvec3(x, 0.0, 0.0));
  return file;
}

TEST(JoinScans, OneFileKeepsItsNameAndArrays) {
  std::vector<NamedScan> scans{{"church", scan_at(1.0, 3)}};
  scans[0].file.points.columns = {{"intensity", std::vector<std::uint16_t>{5, 0, 7}},
                                  {"class", std::vector<std::uint8_t>{0, 0, 0}}};
  const InputObject object = joined(std::move(scans));
  EXPECT_EQ(object.name, "church");
  EXPECT_EQ(object.points.size(), 3U);
  ASSERT_EQ(object.points.columns.size(), 1U) << "a column of zeros says nothing and takes no bytes";
  EXPECT_EQ(object.points.columns[0].number(2), 7.0);
  EXPECT_EQ(find_column(object.points.columns, COLUMN_SCAN), nullptr);
  EXPECT_EQ(object.points.stations.at(0).name, "church");
}

TEST(JoinScans, AttributesThatAFileLacksAreZeroThere) {
  std::vector<NamedScan> scans{{"a", scan_at(1.0, 2)}, {"b", scan_at(2.0, 1)}, {"c", scan_at(3.0, 1)}};
  scans[1].file.points.columns = {{"intensity", std::vector<std::uint16_t>{300}}};
  scans[2].file.points.columns = {{"intensity", std::vector<float>{0.5F}}};
  scans[1].file.points.normal = {glm::vec3(0.0F, 0.0F, 1.0F)};
  scans[2].file.points.grid_cell = {4};
  scans[2].file.points.stations = {{"s", glm::dvec3(1.0), 2, 3}};
  const InputObject object = joined(std::move(scans));
  const Points& points = object.points;
  ASSERT_EQ(points.size(), 4U);
  const Column* intensity = find_column(points.columns, COLUMN_INTENSITY);
  ASSERT_NE(intensity, nullptr);
  ASSERT_EQ(intensity->size(), 4U);
  EXPECT_EQ(intensity->number(1), 0.0);
  EXPECT_EQ(intensity->number(2), 300.0);
  EXPECT_EQ(intensity->number(3), 0.5) << "the wider type holds both files' values";
  ASSERT_EQ(points.normal.size(), 4U);
  EXPECT_EQ(points.normal[0], glm::vec3(0.0F)) << "to be estimated";
  EXPECT_EQ(points.normal[2], glm::vec3(0.0F, 0.0F, 1.0F));
  EXPECT_EQ(points.grid_cell, (std::vector<std::uint32_t>{NO_CELL, NO_CELL, NO_CELL, 4}));
  EXPECT_EQ(points.station, (std::vector<std::uint16_t>{0, 0, 1, 2}));
  EXPECT_EQ(points.stations.at(2).name, "s");
  const Column* scan = find_column(points.columns, COLUMN_SCAN);
  ASSERT_NE(scan, nullptr);
  EXPECT_EQ(scan->number(3), 2.0);
}

/// Of scans whose colours are of unknown scale, the red channel of the first point.
float joined_red(const std::vector<std::uint16_t>& reds) {
  std::vector<NamedScan> scans;
  for (const std::uint16_t red : reds) {
    scans.push_back({"a", scan_at(0.0, 1)});
    scans.back().file.points.stored_color = {{red, 0, 0}};
  }
  const InputObject object = joined(std::move(scans));
  return object.points.color.empty() ? -1.0F : object.points.color[0].x;
}

TEST(JoinScans, ColoursAreJudgedOverAllFiles) {
  EXPECT_FLOAT_EQ(joined_red({255}), 1.0F);
  EXPECT_FLOAT_EQ(joined_red({128}), srgb_to_linear(128.0F / 255.0F));
  EXPECT_FLOAT_EQ(joined_red({128, 256}), srgb_to_linear(128.0F / 255.0F)) << "8 bits that were rounded up";
  EXPECT_FLOAT_EQ(joined_red({128, 40000}), srgb_to_linear(128.0F / 65535.0F))
      << "the first tile is as dark as the second says";
  EXPECT_EQ(joined_red({0, 0}), -1.0F) << "fields that are all zero are no colours";
}

TEST(JoinScans, ColoursOf8BitsIn16AreTheSameHoweverTheyAreStored) {
  for (const std::vector<unsigned>& factors : {std::vector{256U}, {257U}, {256U, 257U}}) {
    std::vector<NamedScan> scans;
    for (const unsigned factor : factors) {
      scans.push_back({"a", scan_at(0.0, 256)});
      for (unsigned value = 0; value < 256; ++value)
        scans.back().file.points.stored_color.emplace_back(static_cast<std::uint16_t>(value * factor));
    }
    const InputObject object = joined(std::move(scans));
    ASSERT_EQ(object.points.color.size(), 256 * factors.size());
    for (std::size_t i = 0; i < object.points.color.size(); ++i)
      EXPECT_EQ(object.points.color[i].x, srgb_to_linear(static_cast<float>(i % 256) / 255.0F)) << i;
  }
}

/// Of one point in each of the scans where `counts` has one: the station of each point, by the name of its scan.
std::string stations_of_points(const std::vector<std::size_t>& counts) {
  std::vector<NamedScan> scans;
  for (std::size_t i = 0; i < counts.size(); ++i)
    scans.push_back({std::string(1, static_cast<char>('a' + i)), scan_at(double(i), counts[i])});
  const InputObject object = joined(std::move(scans));
  const Column* scan = find_column(object.points.columns, COLUMN_SCAN);
  EXPECT_EQ(object.points.station.size(), object.points.size());
  EXPECT_EQ(scan == nullptr ? 0 : scan->size(), object.points.size());
  std::string names;
  for (const std::uint16_t station : object.points.station) names += object.points.stations.at(station).name;
  return names;
}

TEST(JoinScans, PointsKeepTheirStationsBesideEmptyScans) {
  EXPECT_EQ(stations_of_points({2, 0}), "aa");
  EXPECT_EQ(stations_of_points({0, 2}), "bb");
  EXPECT_EQ(stations_of_points({1, 0, 2}), "acc");
  EXPECT_EQ(stations_of_points({2, 0, 0}), "aa");
}

TEST(JoinScans, MoreStationsThanNumbersAreRefused) {
  std::vector<NamedScan> scans{{"a", scan_at(0.0, 1)}};
  scans[0].file.points.stations.resize(65536);
  EXPECT_THROW((void)joined(std::move(scans)), Error);
}

}  // namespace
}  // namespace splatray
