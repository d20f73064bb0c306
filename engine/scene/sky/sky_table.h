/// How bright the environment is where: what chooses directions towards it.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/scene/environment.h"

namespace splatray {

/// Most columns of a sky table: 2 MB, and a cell of 0.35 degrees, less than the sun.
inline constexpr std::uint32_t SKY_COLUMNS_MOST = 1024;

/// Cells of equal angles over an environment, each with the share of all light that comes from it, as a path's vertex chooses
/// them (Pharr, Jakob and Humphreys 2023, "Physically Based Rendering", sec. 12.5). Empty where the environment is constant or
/// black.
struct SkyTable {
  std::uint32_t width = 0, height = 0;  ///< cells
  /// For each row of how many of 2^32 choices a row above it gets, then for each cell, row by row, of how many of its row's
  /// choices one to its left gets.
  std::vector<std::uint32_t> words;
  double irradiance_mean = 0.0;  ///< pi times the mean radiance of all directions, the mean of rgb
};

/// No direction that light comes from has a share of 0, as bilinear filtering shows texels beyond their edge.
[[nodiscard]] SkyTable sky_table(const Environment& environment);

}  // namespace splatray
