/// Which edges that turn much are creases of a body, and which are bends of a curved one.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "preprocess/points.h"

namespace splatray {

/// An edge of two triangles at which the surface turns by more than creases do.
struct TurningEdge {
  std::array<std::uint32_t, 2> triangle, side;
  double turn;  ///< radians
};

/// The triangle across each side of each triangle; what is no triangle's number means none.
using TrianglesAcross = std::span<const std::uint32_t>;

/// Whether each edge stands out: the surface turns there by more than 3 times what the other sides of its two triangles
/// turn it in the same direction, those that turn by more than `crease`, radians, left out. A side turns it only as far as it
/// runs along the edge (the cosine between them): the facets of a cylinder say nothing of the chamfer around its end. Of
/// scanned and sculpted bodies' edges that turn by more than 30 degrees a third do not stand out: there the surface is curved, and
/// the mesh coarse. Most of the others do not go on (without_twigs).
[[nodiscard]] std::vector<std::uint8_t> standing_out(const Mesh& mesh, TrianglesAcross across,
                                                     std::span<const TurningEdge> edges, double crease);

/// Whether each edge is left when, TWIG times, the edges are taken away at which a crease ends in the midst of the surface:
/// where it goes on in none, or in a single one that bends off by more than 50 degrees or turns the surface by more or less than
/// 1.3 times as much. What was cut or cast keeps its way and its angle; where a sculpture is sharp by chance they change at each
/// edge. `weld` is weld_positions of the vertices, `on_border` says of places whether the surface ends there.
[[nodiscard]] std::vector<std::uint8_t> without_twigs(const Mesh& mesh, const std::vector<glm::uint>& weld,
                                                      const std::vector<std::uint8_t>& on_border,
                                                      std::span<const TurningEdge> edges);

/// For each edge, whether edges bound anything on its part of the mesh, the triangles that hang together: these and the borders are
/// together at least as long as the root of the part's area. Shorter ones, however they lie, surround at most a twelfth of it
/// (1 / 4 pi).
[[nodiscard]] std::vector<std::uint8_t> bounding(const Mesh& mesh, TrianglesAcross across,
                                                 std::span<const TurningEdge> edges);

}  // namespace splatray
