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
  constexpr float ONE_ROUNDED = 1.0F + 1e-6F;  // of colours interpolated in a triangle
  for (const Column& column : points.columns)
    require(column.size() == points.size(), "as many values of an attribute as points");
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

void read_and_check(const std::filesystem::path& path) {
  ReadOptions options;
  options.samples = 64;  // or a coarse mesh would get a hundred thousand
  options.keep_meshes = true;
  options.scans.attributes = {"a", "b", "c", "v"};
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
void fuzz_las(FuzzBytes bytes) { read_as("fuzzed.las", bytes); }

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
