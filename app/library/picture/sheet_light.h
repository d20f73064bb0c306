/// Light of a sheet, which is softer than its lines: traced and filtered in cells of several pixels, and laid over pixels of the base
/// colours.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "app/library/shot/shot.h"
#include "engine/image/image.h"

namespace splatray {

/// Pixels of a side of a cell: as many as leave 100 cells an inch. 1, each pixel has its own light, for all but whole sheets of LOOK_SCAN
/// on nothing that go through the denoiser: light is that look's product with the base colour, and noise would be seen as spots of a cell.
[[nodiscard]] std::uint32_t light_cell(const Shot& shot);

/// The sheet with cells for pixels, the last ones of its rows and columns reaching over its border.
[[nodiscard]] Sheet sheet_of_cells(const Sheet& sheet, std::uint32_t cell);

/// What the fine image, which has aov, knows of the cells: the mean colour of their pixels, and the surface of the pixel nearest to their
/// middle.
struct CellSurfaces {
  std::vector<vec4> base;
  std::vector<AovPixel> aov;
};
[[nodiscard]] CellSurfaces surfaces_of_cells(const Image& fine, std::uint32_t cell);

/// Gives the base colours of a sheet the light of its cells, `lit` over `base`: that of the cells around a pixel that show its surface
/// (Kopf et al. 2007, "Joint Bilateral Upsampling"), those that show no other the most. Where there are none, that of all around.
void light_up(const Sheet& sheet, std::uint32_t cell, std::span<const vec4> lit, const CellSurfaces& cells,
              Image& fine);

}  // namespace splatray
