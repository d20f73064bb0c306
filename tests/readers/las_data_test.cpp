/// LAS and LAZ files of SPLATRAY_DATA_DIR: what independent readers found in them.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "preprocess/read/las/read_las.h"
#include "tests/readers/read_error.h"

namespace splatray {
namespace {

using Row = std::map<std::string, std::string>;

std::vector<Row> expected_rows(const std::filesystem::path& table) {
  std::ifstream file(table);
  std::string line;
  std::getline(file, line);
  const auto cells = [](const std::string& text) {
    std::vector<std::string> all;
    std::istringstream in(text);
    for (std::string cell; std::getline(in, cell, ',');) all.push_back(cell);
    return all;
  };
  const std::vector<std::string> names = cells(line);
  std::vector<Row> rows;
  while (std::getline(file, line)) {
    const std::vector<std::string> values = cells(line);
    Row row;
    for (std::size_t i = 0; i < std::min(names.size(), values.size()); ++i) row[names[i]] = values[i];
    const bool is_las = row["file"].ends_with(".las") || row["file"].ends_with(".laz");
    if (is_las) rows.push_back(row);
  }
  return rows;
}

ScanFile read_file(const std::filesystem::path& file, bool keep) {
  ReadOptions options;
  options.scans.keep_withheld = keep;
  std::vector<std::string> notes;
  return read_las(file, options, {notes, options.progress});
}

std::uint64_t count_of_class(const Points& points, std::uint8_t code) {
  const Column* column = find_column(points.columns, COLUMN_CLASS);
  if (column == nullptr) return 0;
  const auto& list = std::get<Pool<std::uint8_t>>(column->values);
  return static_cast<std::uint64_t>(std::count(list.begin(), list.end(), code));
}

void expect_near(double found, const std::string& expected, const std::string& what) {
  const double value = expected.empty() ? 0.0 : std::stod(expected);
  EXPECT_NEAR(found, value, 1e-9 * std::max(1.0, std::abs(value))) << what;
}

void expect_positions(const Points& points, const Row& row) {
  for (int axis = 0; axis < 3 && points.size() > 0; ++axis) {
    const std::string name(1, "xyz"[axis]);
    double least = INFINITY;
    double most = -INFINITY;
    double sum = 0.0;
    for (const glm::dvec3& position : points.position) {
      least = std::min(least, position[axis]);
      most = std::max(most, position[axis]);
      sum += position[axis] - points.position[0][axis];
    }
    expect_near(least, row.at("min_" + name), "min_" + name);
    expect_near(most, row.at("max_" + name), "max_" + name);
    expect_near(points.position[0][axis] + sum / static_cast<double>(points.size()), row.at("mean_" + name),
                "mean_" + name);
  }
}

void expect_row(const std::filesystem::path& file, const Row& row) {
  const ScanFile all = read_file(file, true);
  const Points& points = all.points;
  EXPECT_EQ(std::to_string(all.counts.stored), row.at("stored"));
  EXPECT_EQ(std::to_string(points.size()), row.at("points"));
  EXPECT_EQ(all.counts.missing != 0, row.at("status") == "partial");
  expect_positions(points, row);
  const double count = std::max(1.0, static_cast<double>(points.size()));
  glm::dvec3 color(0.0);
  for (const glm::u16vec3& one : points.stored_color) color += glm::dvec3(one);
  expect_near(color.x / count, row.at("mean_red"), "mean_red");
  expect_near(color.y / count, row.at("mean_green"), "mean_green");
  expect_near(color.z / count, row.at("mean_blue"), "mean_blue");
  double intensity = 0.0;
  if (const Column* column = find_column(points.columns, COLUMN_INTENSITY))
    for (std::size_t i = 0; i < points.size(); ++i) intensity += column->number(i);
  expect_near(intensity / count, row.at("mean_intensity"), "mean_intensity");
  EXPECT_EQ(std::to_string(count_of_class(points, 7)), row.at("class7"));
  EXPECT_EQ(std::to_string(count_of_class(points, 18)), row.at("class18"));
  const ScanFile cleaned = read_file(file, false);
  EXPECT_EQ(std::to_string(cleaned.points.size()), row.at("kept"));
  EXPECT_EQ(std::to_string(cleaned.counts.withheld), row.at("withheld"));
  EXPECT_EQ(cleaned.points.size() + cleaned.counts.withheld + cleaned.counts.noise, points.size());
}

void expect_equal(const std::filesystem::path& las, const std::filesystem::path& laz) {
  const Points a = read_file(las, true).points;
  const Points b = read_file(laz, true).points;
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.stored_color, b.stored_color);
  ASSERT_EQ(a.columns.size(), b.columns.size());
  for (std::size_t i = 0; i < a.columns.size(); ++i)
    EXPECT_TRUE(a.columns[i].values == b.columns[i].values) << a.columns[i].name;
}

TEST(LasData, EveryFileHoldsWhatOtherReadersFind) {
  const char* const data = std::getenv("SPLATRAY_DATA_DIR");
  if (data == nullptr) GTEST_SKIP() << "SPLATRAY_DATA_DIR is not set: no LAS files to read";
  const std::filesystem::path folder = std::filesystem::path(data) / "formats";
  std::size_t pairs = 0;
  const std::vector<Row> rows = expected_rows(folder / "expected.csv");
  EXPECT_GE(rows.size(), 39U);
  for (const Row& row : rows) {
    const std::filesystem::path file = folder / row.at("file");
    SCOPED_TRACE(file);
    expect_row(file, row);
    std::filesystem::path other = file;
    if (file.extension() == ".las" && std::filesystem::exists(other.replace_extension(".laz"))) {
      expect_equal(file, other);
      ++pairs;
    }
  }
  EXPECT_GE(pairs, 11U);
}

TEST(LasData, UnitsAreReported) {
  const char* const data = std::getenv("SPLATRAY_DATA_DIR");
  if (data == nullptr) GTEST_SKIP() << "SPLATRAY_DATA_DIR is not set: no LAS files to read";
  EXPECT_TRUE(
      has_note(read_input({std::filesystem::path(data) / "formats/degrees.las"}, {}), "x and y are degrees"));
}

TEST(LasData, EveryScanIsWhole) {
  const char* const data = std::getenv("SPLATRAY_DATA_DIR");
  if (data == nullptr) GTEST_SKIP() << "SPLATRAY_DATA_DIR is not set: no scans to read";
  const std::pair<const char*, std::size_t> scans[] = {{"vaulted_room", 3021294},
                                                       {"classified_drone", 2568745},
                                                       {"north_carolina", 2269213},
                                                       {"lone_star", 518862}};
  for (const auto& [name, count] : scans) {
    const ScanFile scan =
        read_file(std::filesystem::path(data) / "scans" / (std::string(name) + ".laz"), false);
    EXPECT_EQ(scan.points.size(), count) << name;
    EXPECT_EQ(scan.counts.missing, 0U) << name;
  }
}

}  // namespace
}  // namespace splatray
