// The light of a sheet's cells, against light of each pixel.
#include <gtest/gtest.h>

#include <cmath>

#include "app/library/picture/sheet_light.h"

namespace splatray {
namespace {

constexpr std::uint32_t LIT_WIDTH = 100, LIT_HEIGHT = 40, LIT_CELL = 3, LEVEL_BORDER = 61;

Sheet sheet_of_pixels() {
  Sheet sheet;
  sheet.width = LIT_WIDTH;
  sheet.height = LIT_HEIGHT;
  sheet.corner = {0.0, LIT_HEIGHT};
  return sheet;
}

/// Base colours that differ from pixel to pixel, on two levels that meet at LEVEL_BORDER, within a cell.
Image two_levels() {
  Image image{LIT_WIDTH, LIT_HEIGHT, {}, {}};
  for (std::uint32_t y = 0; y < LIT_HEIGHT; ++y)
    for (std::uint32_t x = 0; x < LIT_WIDTH; ++x) {
      const float shade = 0.3F + 0.5F * std::abs(std::sin(static_cast<float>(7 * x + 3 * y)));
      image.rgba.emplace_back(shade, 0.5F * shade, 0.2F, 1.0F);
      AovPixel pixel{};
      pixel.normal = vec3(0.0F, 0.0F, 1.0F);
      pixel.z = x < LEVEL_BORDER ? 10.0F : 30.0F;
      pixel.object = 0;
      image.aov.push_back(pixel);
    }
  return image;
}

float light_at(std::uint32_t x) { return x < LEVEL_BORDER ? 1.0F : 0.2F + 0.002F * static_cast<float>(x); }

/// What is traced of the cells: the mean of their pixels in the light.
std::vector<vec4> lit_cells(const Image& fine, const Sheet& cells) {
  std::vector<vec4> lit;
  for (std::uint32_t row = 0; row < cells.height; ++row)
    for (std::uint32_t column = 0; column < cells.width; ++column) {
      vec4 sum(0.0F);
      float count = 0.0F;
      for (std::uint32_t y = row * LIT_CELL; y < std::min((row + 1) * LIT_CELL, LIT_HEIGHT); ++y)
        for (std::uint32_t x = column * LIT_CELL; x < std::min((column + 1) * LIT_CELL, LIT_WIDTH); ++x) {
          sum += vec4(light_at(x) * vec3(fine.rgba[y * LIT_WIDTH + x]), 1.0F);
          count += 1.0F;
        }
      lit.push_back(sum / count);
    }
  return lit;
}

TEST(SheetLight, IsThatOfEachPixelAlsoWhereACellShowsTwoSurfaces) {
  const Sheet sheet = sheet_of_pixels(), cells = sheet_of_cells(sheet, LIT_CELL);
  EXPECT_EQ(cells.width, 34U);
  EXPECT_EQ(cells.height, 14U);
  EXPECT_EQ(cells.corner, sheet.corner);
  const Image base = two_levels();
  Image fine = base;
  const CellSurfaces surfaces = surfaces_of_cells(fine, LIT_CELL);
  light_up(sheet, LIT_CELL, lit_cells(fine, cells), surfaces, fine);
  float most = 0.0F;
  for (std::size_t i = 0; i < fine.rgba.size(); ++i) {
    const float wanted = light_at(i % LIT_WIDTH) * base.rgba[i].x;
    most = std::max(most, std::abs(fine.rgba[i].x - wanted) / wanted);
    EXPECT_EQ(fine.rgba[i].w, 1.0F);
  }
  EXPECT_LT(most, 0.03F);
}

TEST(SheetLight, IsThatOfAllAroundWhereNoCellShowsTheSurface) {
  const Sheet sheet = sheet_of_pixels(), cells = sheet_of_cells(sheet, LIT_CELL);
  Image fine = two_levels();
  const std::size_t thin = 20 * LIT_WIDTH + 30;  // beside a cell's middle
  fine.aov[thin].object = 1;
  const vec4 base = fine.rgba[thin];
  light_up(sheet, LIT_CELL, lit_cells(fine, cells), surfaces_of_cells(fine, LIT_CELL), fine);
  EXPECT_NEAR(fine.rgba[thin].x, base.x, 0.01F);
}

TEST(SheetLight, IsOfCellsWhereThePictureIsAWholeOneWithoutNoise) {
  Shot shot;
  Sheet sheet = sheet_of_pixels();
  sheet.asked.dpi = 300.0;
  shot.output = sheet;
  shot.settings.look = LOOK_SCAN;
  shot.settings.transparent = true;
  shot.request.output.denoise = true;
  EXPECT_EQ(light_cell(shot), 3U);
  Shot noisy = shot, part = shot, lit = shot, coarse = shot;
  noisy.request.output.denoise = false;
  part.view.window = {0, 0, 10, 10};
  lit.settings.look = LOOK_LIT;
  sheet.asked.dpi = 150.0;
  coarse.output = sheet;
  for (const Shot* other : {&noisy, &part, &lit, &coarse}) EXPECT_EQ(light_cell(*other), 1U);
}

}  // namespace
}  // namespace splatray
