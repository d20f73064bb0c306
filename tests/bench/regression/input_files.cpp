#include "tests/bench/regression/input_files.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <numeric>
#include <tuple>

#include "engine/base/error.h"
#include "engine/base/srgb.h"
#include "engine/file/atomic_file.h"

namespace splatray::testing {
namespace {

template <typename Number>
void append(std::string& bytes, Number number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof(number));
}

void append_text(std::string& bytes, const char* text, std::size_t size) {
  const std::size_t length = std::strlen(text);
  bytes.append(text, length).append(size - length, '\0');
}

void write(const std::string& bytes, const std::filesystem::path& path) {
  write_file(bytes.data(), bytes.size(), path);
}

/// The part of a grid that has returns.
struct Used {
  std::uint32_t row = UINT32_MAX, column = UINT32_MAX, last_row = 0, last_column = 0;

  void add(std::uint32_t at_row, std::uint32_t at_column) {
    row = std::min(row, at_row);
    column = std::min(column, at_column);
    last_row = std::max(last_row, at_row);
    last_column = std::max(last_column, at_column);
  }
  [[nodiscard]] std::size_t rows() const { return last_row - row + 1; }
  [[nodiscard]] std::size_t columns() const { return last_column - column + 1; }
};

/// The points of a grid's cells, column after column from the lowest row; -1 = no return.
std::vector<std::ptrdiff_t> cells_of(const Points& points, std::size_t station, Used& used) {
  const std::uint32_t columns = points.stations[station].columns;
  for (const bool fill : {false, true}) {
    std::vector<std::ptrdiff_t> cells(fill ? used.rows() * used.columns() : 0, -1);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (points.station[i] != station) continue;
      const std::uint32_t row = points.grid_cell[i] / columns, column = points.grid_cell[i] % columns;
      if (fill)
        cells[(column - used.column) * used.rows() + (row - used.row)] = static_cast<std::ptrdiff_t>(i);
      else
        used.add(row, column);
    }
    if (fill) return cells;
  }
  return {};
}

/// LAS's header: version 1.2, point format 2.
std::string las_header(const glm::dvec3& low, const glm::dvec3& high, std::uint32_t points) {
  std::string bytes = "LASF";
  bytes.append(20, '\0');
  append(bytes, std::uint8_t{1});
  append(bytes, std::uint8_t{2});
  append_text(bytes, "OTHER", 32);
  append_text(bytes, "splatray-guard", 32);
  for (const unsigned number : {1U, 2026U, 227U}) append(bytes, static_cast<std::uint16_t>(number));
  append(bytes, std::uint32_t{227});
  append(bytes, std::uint32_t{0});
  append(bytes, std::uint8_t{2});
  append(bytes, std::uint16_t{26});
  append(bytes, points);
  append(bytes, points);
  bytes.append(16, '\0');
  for (int axis = 0; axis < 3; ++axis) append(bytes, 0.001);
  for (int axis = 0; axis < 3; ++axis) append(bytes, std::floor(low[axis]));
  for (int axis = 0; axis < 3; ++axis) append(bytes, high[axis]), append(bytes, low[axis]);
  return bytes;
}

std::uint16_t number_of(const std::vector<Column>& columns, std::string_view name, std::size_t point) {
  const Column* column = find_column(columns, name);
  return column == nullptr ? std::uint16_t{0} : static_cast<std::uint16_t>(column->number(point));
}

void append_las_point(std::string& bytes, const Points& points, const glm::dvec3& from, std::size_t i) {
  for (int axis = 0; axis < 3; ++axis)
    append(bytes, static_cast<std::int32_t>(std::lround((points.position[i][axis] - from[axis]) / 0.001)));
  append(bytes, number_of(points.columns, COLUMN_INTENSITY, i));
  append(bytes, std::uint8_t{1 | 1 << 3});
  append(bytes, static_cast<std::uint8_t>(number_of(points.columns, COLUMN_CLASS, i)));
  append(bytes, std::uint8_t{0});
  append(bytes, std::uint8_t{0});
  append(bytes, std::uint16_t{0});
  for (glm::length_t channel = 0; channel < 3; ++channel) {
    const float shown = points.color.empty() ? 0.0F : linear_to_srgb(points.color[i][channel]);
    append(bytes, static_cast<std::uint16_t>(std::lround(65535.0F * shown)));
  }
}

std::string npy_header(const std::string& type, const std::string& shape) {
  std::string text = "{'descr': '" + type + "', 'fortran_order': False, 'shape': " + shape + ", }";
  text.append(117 - text.size(), ' ').append("\n");
  std::string bytes("\x93NUMPY\x01\0", 8);
  append(bytes, static_cast<std::uint16_t>(text.size()));
  return bytes + text;
}

/// The values of an array's file.
template <typename Number>
std::vector<Number> read_npy(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  constexpr std::size_t LENGTH_AT = 8;
  std::uint16_t length = 0;
  if (bytes.size() > LENGTH_AT + sizeof(length)) std::memcpy(&length, &bytes[LENGTH_AT], sizeof(length));
  const std::size_t begin = LENGTH_AT + sizeof(length) + length;
  if (length == 0 || bytes.size() < begin)
    throw Error(ExitCode::input_unreadable, path.string() + ": found no array, expected one of NumPy's");
  std::vector<Number> values((bytes.size() - begin) / sizeof(Number));
  std::memcpy(values.data(), &bytes[begin], values.size() * sizeof(Number));
  return values;
}

}  // namespace

void write_ply_points(const Points& points, const std::filesystem::path& path) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                      std::to_string(points.size()) +
                      "\nproperty float x\nproperty float y\nproperty float z\n";
  if (!points.normal.empty()) bytes += "property float nx\nproperty float ny\nproperty float nz\n";
  bytes += "end_header\n";
  for (std::size_t i = 0; i < points.size(); ++i) {
    append(bytes, glm::vec3(points.position[i]));
    if (!points.normal.empty()) append(bytes, points.normal[i]);
  }
  write(bytes, path);
}

SimulatedScan in_grid_order(const SimulatedScan& scan) {
  const Points& points = scan.points;
  std::vector<std::size_t> order(scan.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto place = [&](std::size_t i) {
    const std::uint32_t columns = points.stations[points.station[i]].columns, cell = points.grid_cell[i];
    return std::tuple(points.station[i], cell % columns, cell / columns);
  };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return place(a) < place(b); });
  SimulatedScan ordered;
  ordered.points.stations = points.stations;
  for (const std::size_t i : order) {
    ordered.points.position.push_back(points.position[i]);
    ordered.points.station.push_back(points.station[i]);
    ordered.points.grid_cell.push_back(points.grid_cell[i]);
    ordered.position.push_back(scan.position[i]);
    ordered.normal.push_back(scan.normal[i]);
    ordered.kind.push_back(scan.kind[i]);
    ordered.triangle.push_back(scan.triangle[i]);
  }
  return ordered;
}

void write_ptx(const Points& points, const std::filesystem::path& path) {
  std::string text;
  char line[128];
  for (std::size_t station = 0; station < points.stations.size(); ++station) {
    Used used;
    const std::vector<std::ptrdiff_t> cells = cells_of(points, station, used);
    const glm::dvec3 sensor = *points.stations[station].sensor_world;
    std::snprintf(line, sizeof(line), "%.6f %.6f %.6f", sensor.x, sensor.y, sensor.z);
    const std::string place = line, axes = "1 0 0\n0 1 0\n0 0 1\n";
    text += std::to_string(used.columns()) + "\n" + std::to_string(used.rows()) + "\n" + place + "\n" + axes +
            "1 0 0 0\n0 1 0 0\n0 0 1 0\n" + place + " 1\n";
    for (const std::ptrdiff_t cell : cells) {
      const glm::dvec3 at =
          cell < 0 ? glm::dvec3(0.0) : points.position[static_cast<std::size_t>(cell)] - sensor;
      std::snprintf(line, sizeof(line), cell < 0 ? "0 0 0 0\n" : "%.5f %.5f %.5f 0.5\n", at.x, at.y, at.z);
      text += line;
    }
  }
  write(text, path);
}

void write_las_points(const Points& points, const std::filesystem::path& path) {
  glm::dvec3 low(INFINITY), high(-INFINITY);
  for (const glm::dvec3& position : points.position)
    low = glm::min(low, position), high = glm::max(high, position);
  std::string bytes = las_header(low, high, static_cast<std::uint32_t>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) append_las_point(bytes, points, glm::floor(low), i);
  write(bytes, path);
}

void write_obj_mesh(const Mesh& mesh, const std::filesystem::path& path) {
  std::string text;
  char line[96];
  for (const glm::dvec3& at : mesh.vertices.position) {
    std::snprintf(line, sizeof(line), "v %.9g %.9g %.9g\n", at.x, at.y, at.z);
    text += line;
  }
  for (const glm::uvec3& corner : mesh.triangles) {
    std::snprintf(line, sizeof(line), "f %u %u %u\n", corner.x + 1, corner.y + 1, corner.z + 1);
    text += line;
  }
  write(text, path);
}

void write_point_truth(const SimulatedScan& scan, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const std::string count = std::to_string(scan.size());
  std::string kinds = npy_header("|u1", "(" + count + ",)");
  std::string normals = npy_header("<i2", "(" + count + ", 3)");
  for (std::size_t i = 0; i < scan.size(); ++i) {
    append(kinds, static_cast<std::uint8_t>(scan.kind[i]));
    append(normals, glm::i16vec3(glm::round(32767.0 * scan.normal[i])));
  }
  write(kinds, folder / "kind.npy");
  write(normals, folder / "normal.npy");
}

PointTruth read_point_truth(const std::filesystem::path& folder) {
  PointTruth truth;
  for (const std::uint8_t kind : read_npy<std::uint8_t>(folder / "kind.npy"))
    truth.kind.push_back(static_cast<PointKind>(std::min<std::uint8_t>(kind, POINT_KINDS - 1)));
  for (const glm::i16vec3& normal : read_npy<glm::i16vec3>(folder / "normal.npy"))
    truth.normal.push_back(glm::normalize(glm::vec3(normal)));
  if (truth.normal.size() != truth.kind.size())
    throw Error(ExitCode::input_unreadable, folder.string() + ": found " +
                                                std::to_string(truth.normal.size()) + " normals, expected " +
                                                std::to_string(truth.kind.size()) + ", one for each kind");
  return truth;
}

}  // namespace splatray::testing
