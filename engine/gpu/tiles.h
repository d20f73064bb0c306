/// A picture cut into pieces of one dispatch each.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace splatray {

/// A rectangle of what is made of a picture (View::made), pixels.
struct Tile {
  std::uint32_t x = 0;
  std::uint32_t y = 0;
  std::uint32_t width = 0;
  std::uint32_t height = 0;

  [[nodiscard]] std::size_t pixels() const { return std::size_t{width} * height; }
  bool operator==(const Tile&) const = default;
};

/// Most pixels of a tile.
inline constexpr std::uint32_t TILE_PIXELS = 1U << 20U;
/// Most pixels of one that somebody waits to stop.
inline constexpr std::uint32_t PROMPT_PIXELS = 1U << 15U;

/// Tiles that cover a picture of at least one pixel, each pixel once: full-width bands of a multiple of 8
/// rows where the width allows it; from the top, the first is the largest. At most `most_pixels` each, but for bands of
/// 8 rows.
[[nodiscard]] std::vector<Tile> cut_into_tiles(std::uint32_t width, std::uint32_t height,
                                               std::uint32_t most_pixels = TILE_PIXELS);

}  // namespace splatray
