/// Lines that the discs of a mesh's points end at.
#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "preprocess/mesh/edges/mesh_edges.h"
#include "preprocess/points.h"

namespace splatray {

/// What a point lies on, and how far from it the surface's edges matter.
struct PointOnMesh {
  std::span<const std::uint32_t> triangles;
  double reach_world;
};

/// Fills `points.clip` (ClipFinder); leaves it empty where no point is near an edge. `on_mesh` describes a point by its number,
/// for several threads at once; its first triangle shows where a texture's alpha cuts the mesh out (AlphaMask). Points without a
/// normal get no lines. `weld` is weld_positions of the vertices.
void clip_points(const Mesh& mesh, const std::vector<glm::uint>& weld, const MeshEdges& edges,
                 const std::function<PointOnMesh(std::size_t)>& on_mesh, Points& points);

}  // namespace splatray
