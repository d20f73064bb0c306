#include "engine/gpu/tiles.h"

#include <gtest/gtest.h>

namespace splatray {
namespace {

TEST(Tiles, SmallPictureIsOneTile) {
  EXPECT_EQ(cut_into_tiles(1, 1), (std::vector<Tile>{{0, 0, 1, 1}}));
  EXPECT_EQ(cut_into_tiles(1024, 1024), (std::vector<Tile>{{0, 0, 1024, 1024}}));
}

TEST(Tiles, LargePictureIsBandsOfAMultipleOf8Rows) {
  EXPECT_EQ(cut_into_tiles(1920, 1080), (std::vector<Tile>{{0, 0, 1920, 544}, {0, 544, 1920, 536}}));
}

TEST(Tiles, ExtremeShapesStayWithinTheLimits) {
  constexpr std::uint32_t SIZES[][2] = {{1, 100000}, {100000, 1}, {200000, 20}, {7, 300000}};
  for (const auto& [width, height] : SIZES) {
    std::size_t covered = 0;
    for (const Tile& tile : cut_into_tiles(width, height)) {
      covered += tile.pixels();
      EXPECT_LE(tile.pixels(), TILE_PIXELS);
      EXPECT_LE(tile.height, 65535U);
      EXPECT_EQ(tile.y % 8, 0U);
    }
    EXPECT_EQ(covered, std::size_t{width} * height);
  }
}

}  // namespace
}  // namespace splatray
