#include "tests/bench/regression/source_mesh.h"

#include <cmath>

#include "engine/base/error.h"

namespace splatray::testing {

Mesh source_mesh(const std::filesystem::path& path) {
  ReadOptions options;
  options.keep_meshes = true;
  options.clip = false;
  Input input = read_input({path}, options);
  if (input.objects.front().meshes.empty())
    throw Error(ExitCode::input_unreadable, path.string() + ": found no triangles, expected a mesh");
  return std::move(input.objects.front().meshes.front());
}

std::array<glm::dvec3, 2> box_of(const Mesh& mesh) {
  glm::dvec3 low(INFINITY), high(-INFINITY);
  for (const glm::uvec3& triangle : mesh.triangles)
    for (int corner = 0; corner < 3; ++corner) {
      low = glm::min(low, mesh.vertices.position[triangle[corner]]);
      high = glm::max(high, mesh.vertices.position[triangle[corner]]);
    }
  return {low, high};
}

}  // namespace splatray::testing
