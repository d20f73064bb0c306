/// Where samples of a mesh are missing along its borders and creases.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "preprocess/mesh/edges/mesh_edges.h"
#include "preprocess/points.h"

namespace splatray {

/// A place on a mesh.
struct MeshPlace {
  std::uint32_t triangle;
  glm::dvec3 weights;  ///< barycentric
};

/// Samples by area miss faces that are narrower than their distance, and the tips of sharp corners; discs of the faces beside
/// them end at the edge. These are the places along the edges, a little inside, that no sample is near of those on the same
/// patch, the triangles joined smoothly; added one after the other, they leave none that has no sample within 0.75 of
/// `spacing_world`. `triangle` and `position` describe the samples; at most `most` places are found, and none where no
/// disc would be clipped.
[[nodiscard]] std::vector<MeshPlace> edge_sites(const Mesh& mesh, const MeshEdges& edges,
                                                const std::vector<std::uint32_t>& triangle,
                                                const std::vector<glm::dvec3>& position, double spacing_world,
                                                std::size_t most);

}  // namespace splatray
