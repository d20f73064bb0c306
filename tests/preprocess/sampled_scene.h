/// Scenes of meshes made in a test.
#pragma once
#include "preprocess/build.h"
#include "preprocess/mesh/sample_mesh.h"

namespace splatray::test {

/// The scene of `points` samples of a mesh, with clip lines.
[[nodiscard]] inline Scene sampled_scene(const Mesh& mesh, std::uint64_t points) {
  Input input;
  InputObject& object = input.objects.emplace_back();
  object.points = sample_surface(mesh, weld_positions(mesh.vertices.position), points, 1, {.clip = true});
  object.surface_area = surface_area(mesh);
  object.measured = false;
  BuildStats stats;
  return build_scene(std::move(input), {}, 1, stats);
}

}  // namespace splatray::test
