/// Scans of SPLATRAY_DATA_DIR against what independent readers found in them (formats/expected.csv) and its README's counts.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "engine/base/srgb.h"
#include "preprocess/base/file_extension.h"
#include "tests/readers/scan_reading.h"

namespace splatray {
namespace {

using Row = std::map<std::string, std::string>;

const char* data_folder() { return std::getenv("SPLATRAY_DATA_DIR"); }

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

/// The rows of files with one of these extensions.
std::vector<Row> expected_rows(const std::filesystem::path& folder,
                               const std::vector<std::string>& extensions) {
  std::ifstream file(folder / "expected.csv");
  std::string line;
  std::getline(file, line);
  const std::vector<std::string> names = cells_of(line);
  std::vector<Row> rows;
  while (std::getline(file, line)) {
    Row row;
    const std::vector<std::string> cells = cells_of(line);
    for (std::size_t i = 0; i < std::min(names.size(), cells.size()); ++i) row[names[i]] = cells[i];
    if (std::find(extensions.begin(), extensions.end(), lower_extension(row["file"])) != extensions.end())
      rows.push_back(row);
  }
  return rows;
}

void expect_near(Row& row, const std::string& name, double found) {
  ASSERT_FALSE(row[name].empty()) << name;
  const double expected = std::stod(row[name]);
  EXPECT_NEAR(found, expected, 1e-6 * std::max(1.0, std::fabs(expected))) << row["file"] << " " << name;
}

void expect_positions(Row& row, const Points& points) {
  const char axes[] = "xyz";
  for (int axis = 0; axis < 3; ++axis) {
    double least = INFINITY;
    double most = -INFINITY;
    double sum = 0.0;
    for (const glm::dvec3& position : points.position) {
      least = std::min(least, position[axis]);
      most = std::max(most, position[axis]);
      sum += position[axis];
    }
    expect_near(row, std::string("min_") + axes[axis], least);
    expect_near(row, std::string("max_") + axes[axis], most);
    expect_near(row, std::string("mean_") + axes[axis], sum / static_cast<double>(points.size()));
  }
}

/// Colours as the file stores them; `color` of meshes is linear.
void expect_attributes(Row& row, const Points& points) {
  const char* const names[] = {"mean_red", "mean_green", "mean_blue"};
  for (int channel = 0; channel < 3 && !row["mean_red"].empty(); ++channel) {
    double sum = 0.0;
    for (const glm::u16vec3& color : points.stored_color) sum += color[channel];
    for (const glm::vec3& color : points.color) sum += std::round(255.0F * linear_to_srgb(color[channel]));
    expect_near(row, names[channel], sum / static_cast<double>(points.size()));
  }
  if (row["mean_intensity"].empty()) return;
  const Column* intensity = find_column(points.columns, COLUMN_INTENSITY);
  ASSERT_NE(intensity, nullptr);
  double sum = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) sum += intensity->number(i);
  EXPECT_NEAR(sum / static_cast<double>(points.size()), std::stod(row["mean_intensity"]), 1e-6)
      << row["file"];
}

ReadScan read_any(const std::filesystem::path& path) {
  if (find_format(path)->read_scan != nullptr) return read_scan(path);
  ReadScan read;
  read.file.points = read_input({path}, {}).objects.at(0).points;
  read.file.counts.stored = read.file.points.size();
  return read;
}

TEST(ScanData, FormatsAreAsIndependentReadersFoundThem) {
  if (data_folder() == nullptr) GTEST_SKIP() << "SPLATRAY_DATA_DIR is not set: no files to compare";
  const std::filesystem::path folder = std::filesystem::path(data_folder()) / "formats";
  std::vector<Row> rows = expected_rows(folder, {".ptx", ".pts", ".pcd", ".ply"});
  EXPECT_GE(rows.size(), 12U);
  for (Row& row : rows) {
    SCOPED_TRACE(row["file"]);
    const ReadScan read = read_any(folder / row["file"]);
    const Points& points = read.file.points;
    EXPECT_EQ(std::to_string(read.file.counts.stored), row["stored"]);
    ASSERT_EQ(std::to_string(points.size()), row["points"]);
    EXPECT_EQ(read.file.counts.missing > 0, row["status"] == "partial");
    EXPECT_EQ(std::to_string(std::max<std::size_t>(points.stations.size(), 1)), row["scans"]);
    expect_positions(row, points);
    expect_attributes(row, points);
    if (row["status"] == "partial") {
      EXPECT_FALSE(strict_error(folder / row["file"]).empty());
    }
  }
}

/// The greatest distance between points of equal number.
double difference(const Points& a, const Points& b) {
  double most = a.size() == b.size() ? 0.0 : INFINITY;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    most = std::max(most, glm::length(a.position[i] - b.position[i]));
  return most;
}

TEST(ScanData, OneCloudInSeveralFormatsIsOneCloud) {
  if (data_folder() == nullptr) GTEST_SKIP() << "SPLATRAY_DATA_DIR is not set: no files to compare";
  const std::filesystem::path folder = std::filesystem::path(data_folder()) / "formats";
  const Points ascii = read_any(folder / "grid_ascii.pcd").file.points;
  const Points binary = read_any(folder / "grid_binary.pcd").file.points;
  const Points compressed = read_any(folder / "grid_compressed.pcd").file.points;
  EXPECT_EQ(difference(binary, compressed), 0.0);
  EXPECT_LT(difference(ascii, binary), 1e-6);
  EXPECT_EQ(binary.stored_color, compressed.stored_color);
  EXPECT_EQ(binary.stored_color, ascii.stored_color);
  EXPECT_EQ(binary.grid_cell, compressed.grid_cell);
  EXPECT_EQ(binary.grid_cell, ascii.grid_cell);
  EXPECT_EQ(ascii.stations.at(0).sensor_world, glm::dvec3(0.5, -1.0, 0.25));
  const Points pts = read_any(folder / "ripple.pts").file.points;
  const Points ptx = read_any(folder / "ripple.ptx").file.points;
  const Points ply = read_any(folder / "ripple_bin.ply").file.points;
  EXPECT_EQ(difference(pts, ptx), 0.0);
  EXPECT_EQ(pts.stored_color, ptx.stored_color);
  EXPECT_EQ(ply.size(), pts.size()) << "its points are in another order";
}

TEST(ScanData, ScansHaveTheirCounts) {
  if (data_folder() == nullptr) GTEST_SKIP() << "SPLATRAY_DATA_DIR is not set: no scans to read";
  const std::filesystem::path folder = std::filesystem::path(data_folder()) / "scans";
  const std::map<std::string, std::size_t> counts = {{"dragonStandRight_0.ply", 41841},
                                                     {"dragon_stand_posed.ptx", 95595},
                                                     {"bunny16k.pts", 16130},
                                                     {"city_site1.pcd", 522674},
                                                     {"room_scan1.pcd", 112586},
                                                     {"table_mug_stereo.pcd", 307200 - 97920},
                                                     {"street_ascii.pcd", 9311},
                                                     {"head_kinect.pcd", 59750},
                                                     {"bunny.pts", 30571},
                                                     {"street_velodyne.bin", 17238},
                                                     {"car_lidar_normals.csv", 24989},
                                                     {"campus_lidar.ply", 69792},
                                                     {"sim_rings.ply", 115200},
                                                     {"dragon_stand_merged.ply", 469193}};
  for (const auto& [name, count] : counts)
    EXPECT_EQ(read_any(folder / name).file.points.size(), count) << name;
  EXPECT_TRUE(read_scan(folder / "city_site1.pcd").has_note("float32"));
  EXPECT_EQ(read_scan(folder / "table_mug_stereo.pcd").file.up, glm::dvec3(0.0, -1.0, 0.0));
  EXPECT_EQ(read_scan(folder / "car_lidar_normals.csv").file.points.normal.size(), 24989U);
  EXPECT_NE(find_column(read_any(folder / "campus_lidar.ply").file.points.columns, COLUMN_INTENSITY),
            nullptr);
  const Points rings = read_any(folder / "sim_rings.ply").file.points;
  EXPECT_EQ(rings.stations.at(0).sensor_world, glm::dvec3(0.0, -0.5, 8.0));
  const std::vector<Station> dragon = read_scan(folder / "dragon_stand_posed.ptx").file.points.stations;
  ASSERT_EQ(dragon.size(), 3U);
  EXPECT_EQ(dragon[0].sensor_world, glm::dvec3(0.6068275, 0.1708290, 1.1651500));
  for (const Station& scan : dragon) EXPECT_TRUE(scan.sensor_world);
}

/// The same range grid as PTX and as Stanford's PLY: neighbours in the grid are neighbours in space.
TEST(ScanData, GridsJoinNeighbours) {
  if (data_folder() == nullptr) GTEST_SKIP() << "SPLATRAY_DATA_DIR is not set: no scans to read";
  const std::filesystem::path folder = std::filesystem::path(data_folder()) / "scans";
  for (const char* name : {"dragonStandRight_0.ply", "dragon_stand_posed.ptx"}) {
    const Points points = read_any(folder / name).file.points;
    const Station& station = points.stations.at(0);
    EXPECT_EQ(station.rows, 262U) << name;
    EXPECT_EQ(station.columns, 483U) << name;
    std::vector<const glm::dvec3*> cells(std::size_t{station.rows} * station.columns, nullptr);
    for (std::size_t i = 0; i < points.size(); ++i)
      if (points.station.empty() || points.station[i] == 0)
        cells.at(points.grid_cell[i]) = &points.position[i];
    std::size_t near = 0;
    std::size_t pairs = 0;
    for (std::size_t cell = 0; cell + station.columns < cells.size(); ++cell)
      for (const std::size_t next : {cell + 1, cell + station.columns})
        if (cells[cell] != nullptr && cells[next] != nullptr) {
          ++pairs;
          near += glm::length(*cells[cell] - *cells[next]) < 0.003 ? 1 : 0;
        }
    EXPECT_GT(pairs, 80000U) << name;
    EXPECT_GT(static_cast<double>(near), 0.95 * static_cast<double>(pairs)) << name;
  }
}

}  // namespace
}  // namespace splatray
