/// Volumes between a surface and a base below or above it.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "app/library/cut/plane_cut.h"
#include "app/library/measure/volume_found.h"
#include "engine/image/region.h"
#include "engine/scene/scene.h"

namespace splatray {

/// What a surface is compared with: an earlier surface, or a plane, whose heights are these at places along CutPlane::right and top.
struct VolumeBase {
  double height = 0.0;
  glm::dvec2 slope{0.0};
  const Scene* earlier = nullptr;
};

/// The surface seen from above, over an outline.
struct VolumeGround {
  const Scene& scene;
  const Region& region;
  CutPlane axes;  ///< toward is up; `near` is not read
  /// Corners along right and top; empty = the rectangle around what the region holds.
  std::vector<glm::dvec2> outline;
  bool is_all = false;  ///< the outline is that rectangle
};

/// The rectangle around what the region holds, along right and top; empty where it holds nothing.
[[nodiscard]] std::vector<glm::dvec2> outline_of(const Scene& scene, const Region& region,
                                                 const CutPlane& axes);

/// Cut and fill by a grid of heights (fill_heights), whose cells are as large as the discs' radius and count with their part of the
/// outline; those at the surface's border, where discs stick out beside the points, do not count. `shifted`: bases each of which the
/// true one may be as well, as far off as a standard deviation. The intervals hold, by their squares, the noise of heights
/// (height_noise) and the base's, what two grids differ by, the other's cells twice as large, and what discs round off; and added to
/// these what surrounds holes, as far as its heights differ, what lies within a cell of the surface's border in the outline, half a
/// cell at the rectangle around all, and, of cut and fill alone, what noise takes for one or the other where surface and base are one.
/// They do not hold an error that all heights have in common, which changes net by it times area. Nothing where the outline holds no
/// surface. The scenes have their pools.
[[nodiscard]] std::optional<VolumeFound> volume_over(const VolumeGround& ground, const VolumeBase& base,
                                                     std::span<const VolumeBase> shifted = {});

/// The part of a raster's cell that lies in an outline.
struct CellPart {
  double area = 0.0;
  glm::dvec2 middle{0.0};  ///< along right and top
};
/// Those of all cells, top row first, world units.
[[nodiscard]] std::vector<CellPart> cell_parts(const glm::dvec2& corner, double cell, std::uint32_t width,
                                               std::uint32_t height, std::span<const glm::dvec2> outline);

}  // namespace splatray
