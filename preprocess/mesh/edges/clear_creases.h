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

/// Of each edge whether it stands out: the surface turns there by more than 2.5 times what it turns at any other side of its two
/// triangles, those that turn by more than `crease`, radians, left out. On scanned and sculpted bodies half of the edges that
/// turn by more than 30 degrees turn less than 2.4 times as much as the surface beside them: there it is curved, and the mesh
/// coarse.
[[nodiscard]] std::vector<std::uint8_t> standing_out(const Mesh& mesh, TrianglesAcross across,
                                                     std::span<const TurningEdge> edges, double crease);

/// Of each edge whether edges bound anything on its part of the mesh, the triangles that hang together: these and the borders are
/// together at least as long as the root of the part's area. Shorter ones, however they lie, surround at most a twelfth of it
/// (1 / 4 pi).
[[nodiscard]] std::vector<std::uint8_t> bounding(const Mesh& mesh, TrianglesAcross across,
                                                 std::span<const TurningEdge> edges);

}  // namespace splatray
