// The targets that read points and meshes.
#include <string_view>

#include "preprocess/points.h"
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
  require(is_beside(points.station, points), "as many station numbers as points, or none");
  require(is_beside(points.grid_cell, points), "as many grid cells as points, or none");
  for (const Column& column : points.columns)
    require(column.size() == points.size(), "as many values as points in each column");
  for (std::size_t i = 0; i < points.station.size(); ++i)
    require(points.station[i] < points.stations.size(), "points are of existing stations");
  for (std::size_t i = 0; i < points.grid_cell.size(); ++i) {
    const Station& station = points.stations.at(points.station.empty() ? 0 : points.station[i]);
    require(
        points.grid_cell[i] == NO_CELL || points.grid_cell[i] < std::uint64_t{station.rows} * station.columns,
        "points are in cells of their station's grid");
  }
  constexpr float ONE_ROUNDED = 1.0F + 1e-6F;  // of colours interpolated in a triangle
  for (const glm::vec3& color : points.color)
    for (int channel = 0; channel < 3; ++channel)
      require(color[channel] >= 0.0F && color[channel] <= ONE_ROUNDED, "colours are 0 to 1");
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
    for (const Mesh& mesh : object.meshes) check_mesh(mesh);
  }
}

void read_and_check(const std::filesystem::path& path, const ScanOptions& scans = {}) {
  ReadOptions options;
  options.scans = scans;
  options.samples = 64;  // or a coarse mesh would get a hundred thousand
  options.keep_meshes = true;
  read_or_refuse([&] { check_input(read_input({path}, options)); });
}

void read_as(const char* name, FuzzBytes bytes) {
  static const MemoryFolder folder;
  read_and_check(folder.write(name, bytes));
}

}  // namespace

void fuzz_ply(FuzzBytes bytes) { read_as("fuzzed.ply", bytes); }
void fuzz_obj(FuzzBytes bytes) { read_as("fuzzed.obj", bytes); }
void fuzz_stl(FuzzBytes bytes) { read_as("fuzzed.stl", bytes); }
void fuzz_vtp(FuzzBytes bytes) { read_as("fuzzed.vtp", bytes); }
void fuzz_pcd(FuzzBytes bytes) { read_as("fuzzed.pcd", bytes); }

void fuzz_text(FuzzBytes bytes) {
  static const MemoryFolder folder;
  if (bytes.empty()) return;
  const char kind = static_cast<char>(bytes[0]);
  ScanOptions scans;
  if (kind == 'c') scans.columns = "y,x,-,z,echo,r,g,b";
  const char* const name = kind == 't' ? "fuzzed.ptx" : kind == 's' ? "fuzzed.pts" : "fuzzed.txt";
  read_and_check(folder.write(name, bytes.subspan(1)), scans);
}

void fuzz_gltf(FuzzBytes bytes) {
  constexpr std::string_view POINTS =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
      "end_header\n0 0 0\n1 2 3\n";
  static const MemoryFolder folder;
  static const auto points =
      folder.write("points.ply", {reinterpret_cast<const std::uint8_t*>(POINTS.data()), POINTS.size()});
  read_and_check(folder.write("fuzzed.gltf", bytes));
}

}  // namespace splatray::testing
