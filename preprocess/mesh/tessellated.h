/// Which edges of a mesh are chords of a curve that its vertices lie on.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "preprocess/mesh/edges/mesh_edges.h"
#include "preprocess/points.h"

namespace splatray {

/// A file means its facets, and its normals are for light, unless places and normals say the same of a curved surface. They do at
/// an edge where the normals of each of its triangles foretell how high the other's third corner lies, and lean alike at both its
/// ends. On a part of the mesh, the triangles that hang together, half of all curved edges must do: of balls, vases and teapots
/// 57 to 100 % do, of scans, of scans with a quarter and a sixteenth of their triangles left, and of coarse drawings 1 to 26 %,
/// as normals there are means of facets, or vertices lie beside the surface. An edge is bent only where all sides around its two
/// triangles are chords: a flat between bevels looks like a dome by its own corners.
///
/// One byte for each of a triangle's sides: 1 where the edge is such a chord and normals turn by 3 degrees and more along it; the
/// same from both triangles. Edges of more than two triangles are none, nor are borders whose vertices are `shared` with other
/// meshes (null = none are), whose normals are not known. Empty where the mesh has no normals. `corners`: corner_normals.
[[nodiscard]] std::vector<std::uint8_t> chord_sides(const Mesh& mesh, const std::vector<glm::uint>& weld,
                                                    const std::vector<glm::vec3>& corners,
                                                    const MeshEdges& edges, const std::vector<bool>* shared);

}  // namespace splatray
