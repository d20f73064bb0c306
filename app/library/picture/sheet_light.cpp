#include "app/library/picture/sheet_light.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/all_cores.h"
#include "preprocess/base/file_extension.h"

namespace splatray {
namespace {

/// A quarter of a millimetre of paper. Light of the sky and of a lamp with a size changes over more than that.
constexpr double CELLS_AN_INCH = 100.0;
constexpr float BASE_LEAST = 0.02F;  ///< light of darker pixels is that of such ones
constexpr float ANY_WEIGHT = 1e-6F;  ///< of a cell that shows another surface
constexpr float ALIKE = 0.25F;       ///< likeness of pixels that show one surface

float square(float x) { return x * x; }

/// How much of the surface at one pixel the one at another is, `way` pixels from it: by the angle between normals, and by the distance
/// from the tangent plane against the width of a cell. 0 to 1.
class Likeness {
 public:
  Likeness(const Sheet& sheet, std::uint32_t cell)
      : right_(sheet.right),
        top_(sheet.top),
        toward_(sheet.toward),
        pixel_(static_cast<float>(sheet.pixel_world)),
        cell_(static_cast<float>(cell * sheet.pixel_world)) {}

  [[nodiscard]] float of(const AovPixel& here, const AovPixel& there, const vec2& way) const {
    if (here.object != there.object || here.object == NO_OBJECT) return 0.0F;
    const float cosine = std::max(glm::dot(here.normal, there.normal), 0.0F);
    const vec3 to = pixel_ * (way.x * right_ - way.y * top_) + (here.z - there.z) * toward_;
    return square(square(cosine) / (1.0F + square(glm::dot(to, here.normal) / cell_)));
  }

 private:
  vec3 right_, top_, toward_;
  float pixel_, cell_;
};

/// A fine image in cells.
struct Cells {
  std::uint32_t side, width, height;

  Cells(const Image& fine, std::uint32_t cell)
      : side(cell), width((fine.width + cell - 1) / cell), height((fine.height + cell - 1) / cell) {}

  /// Calls visit(index of a pixel) for the pixels of a cell.
  template <typename Visit>
  void for_each_pixel(const Image& fine, std::uint32_t x, std::uint32_t y, const Visit& visit) const {
    for (std::uint32_t row = y * side; row < std::min((y + 1) * side, fine.height); ++row)
      for (std::uint32_t column = x * side; column < std::min((x + 1) * side, fine.width); ++column)
        visit(std::size_t{row} * fine.width + column);
  }
  /// The pixel nearest to a cell's middle.
  [[nodiscard]] std::array<std::uint32_t, 2> middle(const Image& fine, std::uint32_t x,
                                                    std::uint32_t y) const {
    return {std::min(x * side + side / 2, fine.width - 1), std::min(y * side + side / 2, fine.height - 1)};
  }
};

/// Light of each cell, and how much it counts as that of the surface in its middle.
struct CellLight {
  std::vector<vec3> light;
  std::vector<float> purity;
};

CellLight cell_light(const Sheet& sheet, const Cells& grid, std::span<const vec4> lit,
                     const CellSurfaces& cells, const Image& fine) {
  const Likeness likeness(sheet, grid.side);
  CellLight result{std::vector<vec3>(lit.size()), std::vector<float>(lit.size())};
  on_all_cores(grid.height, [&](std::size_t row) {
    for (std::uint32_t x = 0; x < grid.width; ++x) {
      const auto y = static_cast<std::uint32_t>(row);
      const std::size_t at = row * grid.width + x;
      result.light[at] = vec3(lit[at]) / glm::max(vec3(cells.base[at]), vec3(BASE_LEAST));
      const auto [middle_x, middle_y] = grid.middle(fine, x, y);
      const vec2 middle(static_cast<float>(middle_x), static_cast<float>(middle_y));
      float sum = 0.0F, count = 0.0F;
      grid.for_each_pixel(fine, x, y, [&](std::size_t pixel) {
        const vec2 way = vec2(pixel % fine.width, pixel / fine.width) - middle;
        sum += likeness.of(cells.aov[at], fine.aov[pixel], way) > ALIKE ? 1.0F : 0.0F;
        count += 1.0F;
      });
      // Light of two surfaces is that of neither: a cell of one alone counts hundreds of times as much.
      result.purity[at] = square(square(square(square(sum / count))));
    }
  });
  return result;
}

/// Weights of three neighbours of a place between them, `at` from the middle one's middle, -0.5 to 0.5: a quadratic B-spline.
std::array<float, 3> spline(float at) {
  return {0.5F * square(0.5F - at), 0.75F - square(at), 0.5F * square(0.5F + at)};
}

/// The light at one pixel.
vec3 light_at(const Likeness& likeness, const Cells& grid, const CellSurfaces& cells, const CellLight& light,
              const Image& fine, std::uint32_t x, std::uint32_t y) {
  const std::uint32_t column = x / grid.side, row = y / grid.side;
  const auto within = [&grid](std::uint32_t pixel) {
    return (static_cast<float>(pixel % grid.side) + 0.5F) / static_cast<float>(grid.side) - 0.5F;
  };
  const std::array<float, 3> across = spline(within(x)), along = spline(within(y));
  const AovPixel& here = fine.aov[std::size_t{y} * fine.width + x];
  vec3 sum(0.0F);
  float weights = 0.0F;
  for (std::uint32_t j = 0; j < 3; ++j)
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t other_x = column + i - 1, other_y = row + j - 1;  // wraps below 0
      if (other_x >= grid.width || other_y >= grid.height) continue;
      const std::size_t other = std::size_t{other_y} * grid.width + other_x;
      const auto [middle_x, middle_y] = grid.middle(fine, other_x, other_y);
      const vec2 way(static_cast<float>(middle_x) - static_cast<float>(x),
                     static_cast<float>(middle_y) - static_cast<float>(y));
      const float like = likeness.of(here, cells.aov[other], way) * light.purity[other];
      const float any = cells.base[other].w > 0.0F ? ANY_WEIGHT * cells.base[other].w : 0.0F;
      const float weight = across[i] * along[j] * (like + any);
      sum += weight * light.light[other];
      weights += weight;
    }
  return weights > 0.0F ? sum / weights : vec3(0.0F);
}

}  // namespace

std::uint32_t light_cell(const Shot& shot) {
  const Request& request = shot.request;
  const bool is_whole = shot.view.window.width == 0 && request.output.resume.empty() &&
                        lower_extension(request.output.path) != ".exr";
  if (shot.sheet() == nullptr || !is_whole || !shot.denoises() || shot.settings.look != LOOK_SCAN ||
      !shot.settings.transparent || request.settings.has_goal())
    return 1;
  return static_cast<std::uint32_t>(std::max(std::floor(shot.sheet()->asked.dpi / CELLS_AN_INCH), 1.0));
}

Sheet sheet_of_cells(const Sheet& sheet, std::uint32_t cell) {
  Sheet cells = sheet;
  cells.pixel_world *= cell;
  cells.width = (sheet.width + cell - 1) / cell;
  cells.height = (sheet.height + cell - 1) / cell;
  return cells;
}

CellSurfaces surfaces_of_cells(const Image& fine, std::uint32_t cell) {
  const Cells grid(fine, cell);
  const std::size_t count = std::size_t{grid.width} * grid.height;
  CellSurfaces cells{std::vector<vec4>(count), std::vector<AovPixel>(count)};
  on_all_cores(grid.height, [&](std::size_t row) {
    for (std::uint32_t x = 0; x < grid.width; ++x) {
      const auto y = static_cast<std::uint32_t>(row);
      vec4 sum(0.0F);
      float pixels = 0.0F;
      grid.for_each_pixel(fine, x, y, [&](std::size_t pixel) {
        sum += fine.rgba[pixel];
        pixels += 1.0F;
      });
      const auto [middle_x, middle_y] = grid.middle(fine, x, y);
      cells.base[row * grid.width + x] = sum / pixels;
      cells.aov[row * grid.width + x] = fine.aov[std::size_t{middle_y} * fine.width + middle_x];
    }
  });
  return cells;
}

void light_up(const Sheet& sheet, std::uint32_t cell, std::span<const vec4> lit, const CellSurfaces& cells,
              Image& fine) {
  const Cells grid(fine, cell);
  const CellLight light = cell_light(sheet, grid, lit, cells, fine);
  const Likeness likeness(sheet, cell);
  on_all_cores(fine.height, [&](std::size_t row) {
    for (std::uint32_t x = 0; x < fine.width; ++x) {
      vec4& pixel = fine.rgba[row * fine.width + x];
      if (!(pixel.w > 0.0F)) continue;
      const vec3 here = light_at(likeness, grid, cells, light, fine, x, static_cast<std::uint32_t>(row));
      pixel = vec4(vec3(pixel) * here, pixel.w);
    }
  });
}

}  // namespace splatray
