/// Points on meshes: at the vertices, or spread evenly over the area.
#pragma once
#include <cstdint>
#include <vector>

#include "preprocess/mesh/mesh_normals.h"
#include "preprocess/points.h"

namespace splatray {

/// What points on a mesh know of its creases and borders.
struct MeshCreases {
  double cosine = DEFAULT_CREASE_COSINE;      ///< of the angle by which a mesh turns at a crease
  bool clip = false;                          ///< discs end there: fills Points::clip
  const std::vector<bool>* shared = nullptr;  ///< vertices where other meshes have some too; null = none
};

/// Sum of the triangles' areas, world units^2.
[[nodiscard]] double surface_area(const Mesh& mesh);

/// Whether splats at the vertices cannot show the surface: more than a tenth of the area lies in triangles
/// whose longest edge exceeds 1 % of the mesh's diagonal (a box of 12 triangles, the walls of a room).
[[nodiscard]] bool is_coarse(const Mesh& mesh);

/// One point per used vertex with its normal (given, or angle-weighted from the triangles), colour, radius
/// and attributes. Vertices that coincide in position and, within 2 degrees, in normal are one point: the first.
/// `weld` is weld_positions of the vertices.
[[nodiscard]] Points vertex_points(const Mesh& mesh, const std::vector<glm::uint>& weld,
                                   const MeshCreases& creases = {});

/// `count` points, spread by area, closer together where textures have detail (sample_pieces), less those where the texture's
/// alpha cuts the mesh out; where discs end at edges, more by those that edges lack (edge_sites). Triangles are ordered along a
/// Morton curve; the i-th point takes the i-th of `count` equal shares of the area times density on the way (systematic
/// sampling). Its place in the share's piece of a triangle is a Fibonacci lattice: height from the share, side from multiples of
/// the golden ratio (Kronecker sequence, Niederreiter 1992), that fans out from the corner at which it is least slanted.
/// Deterministic for a seed. Normals are corner_normals interpolated, at most 20 degrees from the triangle's. Points, and the
/// edges that discs end at, lie on the facets, or on the curve that these are chords of (SmoothSurface); attributes are interpolated, whole numbers the nearest corner's; radii are not passed on. The mesh must have a positive, finite area
/// unless count is 0.
[[nodiscard]] Points sample_surface(const Mesh& mesh, const std::vector<glm::uint>& weld, std::uint64_t count,
                                    std::uint64_t seed, const MeshCreases& creases = {});

}  // namespace splatray
