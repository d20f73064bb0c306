#include "engine/gpu/tiles.h"

#include <algorithm>

namespace splatray {
namespace {

/// Keeps a band of 8 rows within TILE_PIXELS.
constexpr std::uint32_t MOST_COLUMNS = 1U << 16U;
/// Keeps the groups of ORDER_LINEAR, one per row, within the 65535 that any device takes.
constexpr std::uint32_t MOST_ROWS = 1U << 15U;

}  // namespace

std::vector<Tile> cut_into_tiles(std::uint32_t width, std::uint32_t height, std::uint32_t most_pixels) {
  const std::uint32_t tile_width = std::min(width, MOST_COLUMNS);
  const std::uint32_t tile_height = std::clamp(most_pixels / tile_width / 8 * 8, 8U, MOST_ROWS);
  std::vector<Tile> tiles;
  for (std::uint32_t y = 0; y < height; y += tile_height)
    for (std::uint32_t x = 0; x < width; x += tile_width)
      tiles.push_back({x, y, std::min(tile_width, width - x), std::min(tile_height, height - y)});
  return tiles;
}

}  // namespace splatray
