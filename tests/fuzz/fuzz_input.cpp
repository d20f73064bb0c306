// The targets that read points and meshes.
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <iterator>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "preprocess/points.h"
#include "preprocess/read/e57/crc32c.h"
#include "preprocess/read/formats.h"
#include "tests/fuzz/build_and_show.h"
#include "tests/fuzz/memory_folder.h"
#include "tests/fuzz/require.h"
#include "tests/fuzz/targets.h"

namespace splatray::testing {
namespace {

template <class Array>
bool is_beside(const Array& attribute, const Points& points) {
  return attribute.empty() || attribute.size() == points.size();
}

void check_points(const Points& points) {
  require(is_beside(points.normal, points), "as many normals as points, or none");
  require(is_beside(points.color, points), "as many colours as points, or none");
  require(is_beside(points.radius, points), "as many radii as points, or none");
  constexpr float ONE_ROUNDED = 1.0F + 1e-6F;  // of colours interpolated in a triangle
  for (const glm::vec3& color : points.color)
    for (int channel = 0; channel < 3; ++channel)
      require(color[channel] >= 0.0F && color[channel] <= ONE_ROUNDED, "colours are 0 to 1");
}

/// What readers of scans promise beside.
void check_stations(const Points& points) {
  require(is_beside(points.station, points), "as many stations' numbers as points, or none");
  require(is_beside(points.grid_cell, points), "as many grid cells as points, or none");
  for (const Column& column : points.columns)
    require(column.size() == points.size(), "as many values of an attribute as points");
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t number = points.station.empty() ? 0 : points.station[i];
    require(points.stations.empty() || number < points.stations.size(), "points are of existing stations");
    if (points.grid_cell.empty() || points.grid_cell[i] == NO_CELL) continue;
    const Station& station = points.stations.at(number);
    require(points.grid_cell[i] < std::uint64_t{station.rows} * station.columns, "cells are of their grid");
  }
}

void check_mesh(const Mesh& mesh) {
  const std::size_t count = mesh.vertices.size();
  require(mesh.texcoord.empty() || mesh.texcoord.size() == count, "a texture coordinate per vertex, or none");
  for (const glm::uvec3& triangle : mesh.triangles)
    require(triangle.x < count && triangle.y < count && triangle.z < count,
            "triangles use existing vertices");
}

void check_input(const Input& input) {
  for (const std::string& note : input.notes)
    require(note.find('\n') == std::string::npos, "a note is one line");
  require(!input.objects.empty(), "at least one object");
  for (const InputObject& object : input.objects) {
    require(object.points.size() > 0, "no object without points");
    check_points(object.points);
    check_stations(object.points);
    for (const Mesh& mesh : object.meshes) check_mesh(mesh);
  }
}

/// A whole file of another format with some points or none, by `choice`.
std::filesystem::path other_file(std::uint64_t choice) {
  constexpr std::pair<const char*, std::string_view> FILES[] = {
      {"none.csv", "x,y,z\n"},
      {"some.csv", "x,y,z,intensity,r,g,b\n0,0,0,1,9,9,9\n1,0,0,2,9,9,9\n0,1,0,3,9,9,9\n"},
      {"none.pcd", "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 0\nHEIGHT 1\nPOINTS 0\nDATA binary\n"},
      {"some.ptx",
       "1\n2\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n1 0 0 0.5\n2 0 0 0.5\n"},
      {"none.ply",
       "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float z\n"
       "end_header\n"}};
  static const MemoryFolder folder;
  const auto& [name, text] = FILES[choice % std::size(FILES)];
  return folder.write(name, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

/// Reads the file, then builds and shows what it holds, by parameters that follow from its bytes; then reads it before and behind
/// another one.
void read_and_check(const std::filesystem::path& path, FuzzBytes bytes, const ScanOptions& scans = {}) {
  ReadOptions options;
  options.scans = scans;
  options.samples = 64;  // or a coarse mesh would get a hundred thousand
  options.keep_meshes = true;
  options.scans.attributes = {"a", "b", "c", "v"};
  options.threads = 1;
  const std::uint64_t choice = XXH3_64bits(bytes.data(), bytes.size());
  read_or_refuse([&] {
    Input input = read_input({path}, options);
    check_input(input);
    build_and_show(std::move(input), choice);
  });
  const std::filesystem::path other = other_file(choice);
  for (const auto& files : {std::vector{path, other}, std::vector{other, path}})
    read_or_refuse([&] { check_input(read_input(files, options)); });
}

void read_as(const char* name, FuzzBytes bytes) {
  static const MemoryFolder folder;
  read_and_check(folder.write(name, bytes), bytes);
}

}  // namespace

void fuzz_ply(FuzzBytes bytes) { read_as("fuzzed.ply", bytes); }
void fuzz_obj(FuzzBytes bytes) { read_as("fuzzed.obj", bytes); }
void fuzz_stl(FuzzBytes bytes) { read_as("fuzzed.stl", bytes); }
void fuzz_vtp(FuzzBytes bytes) { read_as("fuzzed.vtp", bytes); }
void fuzz_vtk(FuzzBytes bytes) {
  read_as(!bytes.empty() && bytes[0] == '<' ? "fuzzed.vtu" : "fuzzed.vtk", bytes);
}
void fuzz_las(FuzzBytes bytes) { read_as("fuzzed.las", bytes); }

void fuzz_e57(FuzzBytes bytes) {
  constexpr std::size_t PAGE = 1024;
  constexpr std::size_t CONTENT = 1020;
  read_as("fuzzed.e57", bytes);
  std::vector<std::uint8_t> sealed(bytes.begin(), bytes.end());
  sealed.resize((sealed.size() + PAGE - 1) / PAGE * PAGE);
  for (std::size_t page = 0; page < sealed.size(); page += PAGE) {
    const std::uint32_t checksum = crc32c(sealed.data() + page, CONTENT);
    for (std::size_t i = 0; i < 4; ++i)
      sealed[page + CONTENT + i] = static_cast<std::uint8_t>(checksum >> (24 - 8 * i));
  }
  read_as("fuzzed.e57", sealed);
}

void fuzz_pcd(FuzzBytes bytes) { read_as("fuzzed.pcd", bytes); }

void fuzz_text(FuzzBytes bytes) {
  static const MemoryFolder folder;
  if (bytes.empty()) return;
  const char kind = static_cast<char>(bytes[0]);
  ScanOptions scans;
  if (kind == 'c') scans.columns = "y,x,-,z,echo,r,g,b";
  const char* const name = kind == 't'   ? "fuzzed.ptx"
                           : kind == 's' ? "fuzzed.pts"
                           : kind == 'b' ? "fuzzed.bin"
                                         : "fuzzed.txt";
  read_and_check(folder.write(name, bytes.subspan(1)), bytes, scans);
}

void fuzz_gltf(FuzzBytes bytes) {
  constexpr std::string_view POINTS =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
      "end_header\n0 0 0\n1 2 3\n";
  static const MemoryFolder folder;
  static const auto points =
      folder.write("points.ply", {reinterpret_cast<const std::uint8_t*>(POINTS.data()), POINTS.size()});
  read_and_check(folder.write("fuzzed.gltf", bytes), bytes);
}

void fuzz_format(FuzzBytes bytes) {
  static const MemoryFolder folder;
  static const std::vector<std::string> extensions = [] {
    std::istringstream words(format_extensions());
    return std::vector<std::string>(std::istream_iterator<std::string>(words), {});
  }();
  if (bytes.empty()) return;
  const std::string name = "fuzzed" + extensions[bytes[0] % extensions.size()];
  read_and_check(folder.write(name, bytes.subspan(1)), bytes);
}

}  // namespace splatray::testing
