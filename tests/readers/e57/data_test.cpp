/// Real E57 files of SPLATRAY_DATA_DIR against what independent readers found in them.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>

#include "preprocess/read/e57/read_e57.h"
#include "tests/readers/read_error.h"

namespace splatray {
namespace {

std::filesystem::path data_folder() {
  const char* const data = std::getenv("SPLATRAY_DATA_DIR");
  return data == nullptr ? "" : data;
}

constexpr const char* NO_DATA = "SPLATRAY_DATA_DIR is not set: no real E57 files to read";

ScanFile read_file(const std::filesystem::path& path, std::vector<std::string>& notes,
                   const ReadOptions& options = {}) {
  return read_e57(path, options, {notes, options.progress});
}

using Row = std::map<std::string, std::string>;

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream text(line);
  for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
  return cells;
}

std::vector<Row> table(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  const std::vector<std::string> names = split(line);
  std::vector<Row> rows;
  while (std::getline(file, line)) {
    const std::vector<std::string> cells = split(line);
    rows.emplace_back();
    for (std::size_t i = 0; i < std::min(names.size(), cells.size()); ++i) rows.back()[names[i]] = cells[i];
  }
  return rows;
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

void expect_positions(const Points& points, const Row& row, double scale) {
  for (int axis = 0; axis < 3; ++axis) {
    const std::string name(1, "xyz"[axis]);
    std::vector<double> values;
    for (const glm::dvec3& position : points.position) values.push_back(position[axis]);
    const double tolerance = 1e-9 * scale;
    EXPECT_NEAR(*std::min_element(values.begin(), values.end()), std::stod(row.at("min_" + name)), tolerance);
    EXPECT_NEAR(*std::max_element(values.begin(), values.end()), std::stod(row.at("max_" + name)), tolerance);
    EXPECT_NEAR(mean(values), std::stod(row.at("mean_" + name)), tolerance);
  }
}

void expect_attributes(const Points& points, const Row& row) {
  static const std::array<std::string, 3> CHANNELS = {"mean_red", "mean_green", "mean_blue"};
  EXPECT_EQ(points.stored_color.empty(), row.at("mean_red").empty());
  for (int channel = 0; channel < 3 && !points.stored_color.empty(); ++channel) {
    std::vector<double> values;
    for (const glm::u16vec3& color : points.stored_color) values.push_back(color[channel]);
    EXPECT_NEAR(mean(values), std::stod(row.at(CHANNELS.at(static_cast<std::size_t>(channel)))),
                1e-9 * 255.0);
  }
  const Column* intensity = find_column(points.columns, COLUMN_INTENSITY);
  EXPECT_EQ(intensity == nullptr, row.at("mean_intensity").empty());
  if (intensity == nullptr) return;
  std::vector<double> values;
  for (std::size_t i = 0; i < intensity->size(); ++i) values.push_back(intensity->number(i));
  const double expected = std::stod(row.at("mean_intensity"));
  EXPECT_NEAR(mean(values), expected, 1e-7 * std::max(1.0, std::abs(expected))) << "stored as float";
}

void expect_row(const std::filesystem::path& path, const Row& row) {
  SCOPED_TRACE(path);
  std::vector<std::string> notes;
  ReadOptions options;
  if (row.at("status") == "checksum") {
    EXPECT_NE(read_error(path).find("does not match its checksum"), std::string::npos);
    options.scans.ignore_checksums = true;
  }
  const ScanFile file = read_file(path, notes, options);
  EXPECT_EQ(notes.size(), row.at("status") == "checksum" ? 1U : 0U);
  EXPECT_EQ(file.counts.stored, std::stoull(row.at("stored")));
  EXPECT_EQ(file.counts.missing, 0U);
  EXPECT_EQ(file.points.size(), std::stoull(row.at("points")));
  EXPECT_EQ(file.counts.no_return, file.counts.stored - file.points.size());
  EXPECT_EQ(file.points.stations.size(), std::stoull(row.at("scans")));
  EXPECT_EQ(file.up, glm::dvec3(0.0, 0.0, 1.0));
  if (file.points.size() == 0) return;
  double scale = 0.0;
  for (const char* name : {"min_x", "min_y", "min_z", "max_x", "max_y", "max_z"})
    scale = std::max(scale, std::abs(std::stod(row.at(name))));
  expect_positions(file.points, row, scale);
  expect_attributes(file.points, row);
}

TEST(E57Data, EveryFileOfTheTableIsAsItSays) {
  if (data_folder().empty()) GTEST_SKIP() << NO_DATA;
  std::size_t files = 0;
  for (const Row& row : table(data_folder() / "formats/expected.csv")) {
    if (!row.at("file").ends_with(".e57")) continue;
    expect_row(data_folder() / "formats" / row.at("file"), row);
    ++files;
  }
  EXPECT_EQ(files, 16U);
}

TEST(E57Data, RealNormalsAndGridsAndSensors) {
  if (data_folder().empty()) GTEST_SKIP() << NO_DATA;
  std::vector<std::string> notes;
  const ScanFile normals = read_file(data_folder() / "formats/testWithNormals.e57", notes);
  ASSERT_EQ(normals.points.normal.size(), 2U);
  EXPECT_EQ(normals.points.stations[0].name, "dummyWithNormals - Cloud");
  const ScanFile grid = read_file(data_folder() / "formats/spherical_grid.e57", notes);
  const Station& station = grid.points.stations.at(0);
  EXPECT_EQ(station.sensor_world, glm::dvec3(10.0, -5.0, 1.5));
  EXPECT_EQ(station.rows, 60U);
  EXPECT_EQ(station.columns, 120U);
  ASSERT_EQ(grid.points.grid_cell.size(), grid.points.size());
  EXPECT_TRUE(std::is_sorted(grid.points.grid_cell.begin(), grid.points.grid_cell.end()));
  const ScanFile bunny = read_file(data_folder() / "scans/bunny.e57", notes);
  EXPECT_EQ(bunny.points.size(), 30571U);
  EXPECT_FALSE(bunny.points.stations.at(0).sensor_world) << "a model in its own coordinates";
}

TEST(E57Data, PosedRangeScansOfTheDragon) {
  if (data_folder().empty()) GTEST_SKIP() << NO_DATA;
  std::vector<std::string> notes;
  const Points points = read_file(data_folder() / "scans/dragon_stand_posed.e57", notes).points;
  EXPECT_TRUE(notes.empty());
  const std::vector<Row> rows = table(data_folder() / "scans/dragon_stand_posed.csv");
  ASSERT_EQ(points.stations.size(), rows.size());
  ASSERT_EQ(points.station.size(), points.size());
  ASSERT_EQ(points.grid_cell.size(), points.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Station& station = points.stations[i];
    EXPECT_EQ(station.name, rows[i].at("scan"));
    ASSERT_TRUE(station.sensor_world);
    EXPECT_NEAR(station.sensor_world->x, std::stod(rows[i].at("sensor_x")), 1e-6);
    EXPECT_NEAR(station.sensor_world->y, std::stod(rows[i].at("sensor_y")), 1e-6);
    EXPECT_NEAR(station.sensor_world->z, std::stod(rows[i].at("sensor_z")), 1e-6);
    EXPECT_EQ(std::count(points.station.begin(), points.station.end(), i), std::stol(rows[i].at("points")));
    EXPECT_GT(station.rows, 100U);
    EXPECT_LE(station.rows, std::stoul(rows[i].at("rows")));
    EXPECT_LE(station.columns, std::stoul(rows[i].at("columns")));
  }
}

TEST(E57Data, StationsOfTheSimulatedChurch) {
  if (data_folder().empty()) GTEST_SKIP() << NO_DATA;
  std::vector<std::string> notes;
  const ScanFile file = read_file(data_folder() / "scans/sim_sibenik_tls.e57", notes);
  const std::vector<glm::dvec3> sensors{{8.0, 1.7, 0.0}, {19.0, 1.7, 1.0}, {2.0, 2.84, 0.0}};
  EXPECT_EQ(file.points.size(), 669600U);
  ASSERT_EQ(file.points.stations.size(), sensors.size());
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const Station& station = file.points.stations[i];
    EXPECT_EQ(station.name, "station " + std::to_string(i));
    EXPECT_EQ(station.sensor_world, sensors[i]);
    EXPECT_EQ(station.rows, 310U);
    EXPECT_EQ(station.columns, 720U);
  }
  ASSERT_EQ(file.points.columns.size(), 1U);
  EXPECT_EQ(file.points.columns[0].name, COLUMN_INTENSITY);
}

}  // namespace
}  // namespace splatray
