#include "app/library/cut/volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "app/library/cut/disc_radius.h"
#include "app/library/cut/height_raster.h"
#include "app/library/measure/measure.h"
#include "engine/scene/scene_splat.h"

namespace splatray {
namespace {

constexpr double MOST_CELLS = 4e6;

using Outline = std::vector<glm::dvec2>;

/// The part of a polygon on one side of a line along an axis (Sutherland and Hodgman 1974): up to `end`, or from it on.
Outline clipped(const Outline& polygon, int axis, double end, bool is_below) {
  Outline part;
  const auto inside = [&](const glm::dvec2& at) { return is_below ? at[axis] <= end : at[axis] >= end; };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
    if (inside(from)) part.push_back(from);
    if (inside(from) == inside(to)) continue;
    glm::dvec2 at = glm::mix(from, to, (end - from[axis]) / (to[axis] - from[axis]));
    at[axis] = end;
    part.push_back(at);
  }
  return part;
}

/// Area and middle of a polygon.
CellPart part_of(const Outline& polygon) {
  CellPart part;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const glm::dvec2 a = polygon[i] - polygon[0], b = polygon[i + 1] - polygon[0];
    const double area = 0.5 * (a.x * b.y - a.y * b.x);
    part.area += area;
    part.middle += area * (a + b) / 3.0;
  }
  if (part.area != 0.0) part.middle = polygon[0] + part.middle / part.area;
  part.area = std::abs(part.area);
  return part;
}

/// Takes the cells beside unknown ones away: discs stick out by about a cell beside where points end.
void take_border_away(HeightRaster& raster) {
  const std::vector<double> before = raster.values;
  const std::size_t width = raster.width;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const std::size_t x = i % width, y = i / width;
    const bool is_border = (x > 0 && std::isnan(before[i - 1])) || (y > 0 && std::isnan(before[i - width])) ||
                           (x + 1 < width && std::isnan(before[i + 1])) ||
                           (y + 1 < raster.height && std::isnan(before[i + width]));
    if (is_border) raster.values[i] = std::numeric_limits<double>::quiet_NaN();
  }
}

/// Heights, and how far those between others may be off.
struct SeenHeights {
  HeightRaster raster;
  HeightRaster measured;  ///< without what lies between others
  std::vector<double> spreads;

  SeenHeights(const Scene& scene, const Region& region, const CutPlane& axes, HeightRaster cells)
      : raster(std::move(cells)) {
    fill_heights(scene, region, axes, raster);
    measured = raster;
    spreads = fill_holes(raster);
    take_border_away(raster);
  }
};

/// Sums over the cells of a grid.
struct Sums {
  double cut = 0.0, fill = 0.0, area = 0.0, uncovered = 0.0;
  double holes = 0.0;  ///< what the volumes may be off by in holes
  double bends = 0.0;  ///< area times what a cell's four neighbours lie above it, all together
  /// What lies of net, cut and fill in cells in which the surface may end.
  std::array<double, 3> borders{};
};

/// One grid over the outline.
class VolumeGrid {
 public:
  VolumeGrid(const VolumeGround& ground, const VolumeBase& base, double cell) : ground_(ground) {
    glm::dvec2 low = ground.outline.front(), high = low;
    for (const glm::dvec2& corner : ground.outline) {
      low = glm::min(low, corner);
      high = glm::max(high, corner);
    }
    const glm::dvec2 cells = glm::max(glm::ceil((high - low) / cell), glm::dvec2(1.0));
    const HeightRaster raster{{low.x, low.y + cells.y * cell},
                              cell,
                              static_cast<std::uint32_t>(cells.x),
                              static_cast<std::uint32_t>(cells.y),
                              {}};
    parts_ = cell_parts(raster.corner, cell, raster.width, raster.height, ground.outline);
    surface_.emplace(ground.scene, ground.region, ground.axes, raster);
    if (base.earlier != nullptr) earlier_.emplace(*base.earlier, ground.region, ground.axes, raster);
  }

  [[nodiscard]] Sums sums(const VolumeBase& base) const {
    Sums sums;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      if (parts_[i].area == 0.0) continue;
      const double above = height_above(base, i);
      if (std::isnan(above)) {
        sums.uncovered += parts_[i].area;
        continue;
      }
      sums.area += parts_[i].area;
      (above > 0.0 ? sums.cut : sums.fill) += parts_[i].area * std::abs(above);
      sums.holes += parts_[i].area * std::hypot(surface_->spreads[i], earlier_ ? earlier_->spreads[i] : 0.0);
      sums.bends +=
          parts_[i].area * (bend_at(surface_->raster, i) + (earlier_ ? bend_at(earlier_->raster, i) : 0.0));
      const double border = border_part(base, i) * parts_[i].area * std::abs(above);
      sums.borders[0] += border;
      sums.borders[above > 0.0 ? 1 : 2] += border;
    }
    return sums;
  }

  /// Variances of net, cut and fill that come of heights' noise, and what it takes for cut and fill where both surfaces are one.
  struct Noise {
    std::array<double, 3> variances{};
    double taken = 0.0;
  };
  [[nodiscard]] Noise noise(const VolumeBase& base) const {
    std::vector<std::vector<double>> factors(3, std::vector<double>(parts_.size()));
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const double above = height_above(base, i);
      if (std::isnan(above)) continue;
      factors[0][i] = parts_[i].area;
      factors[above > 0.0 ? 1 : 2][i] = parts_[i].area;
    }
    Noise noise;
    double squares = 0.0;
    const auto add = [&](const Scene& scene, const SeenHeights& heights) {
      const double known = most_noise_world(scene.stations);
      const HeightNoise found =
          height_noise(scene, ground_.region, ground_.axes, heights.measured, factors, known);
      for (std::size_t i = 0; i < 3; ++i) noise.variances[i] += found.variances[i];
      squares += std::pow(std::max(found.residual, known), 2.0);
    };
    add(ground_.scene, *surface_);
    if (earlier_) add(*base.earlier, *earlier_);
    const double deviation = std::sqrt(squares);
    for (std::size_t i = 0; i < parts_.size(); ++i)
      if (factors[0][i] > 0.0) noise.taken += parts_[i].area * taken_at(height_above(base, i), deviation);
    return noise;
  }

 private:
  /// How far the surface lies above the base in the middle of the part of a cell that the outline has; NaN where one of both is not
  /// known.
  [[nodiscard]] double height_above(const VolumeBase& base, std::size_t cell) const {
    const glm::dvec2& middle = parts_[cell].middle;
    const double height = height_at(surface_->raster, cell, middle);
    return height - (earlier_ ? height_at(earlier_->raster, cell, middle)
                              : base.height + glm::dot(base.slope, middle));
  }

  /// The part of a known cell by which the surface may end elsewhere: all of it beside unknown ones, half at the rectangle around all
  /// points, which their noise makes larger.
  [[nodiscard]] double border_part(const VolumeBase& base, std::size_t cell) const {
    const std::size_t width = surface_->raster.width, x = cell % width, y = cell / width;
    double part = 0.0;
    const auto add = [&](bool is_inside, std::size_t beside) {
      if (!is_inside)
        part = std::max(part, ground_.is_all ? 0.5 : 0.0);
      else if (parts_[beside].area > 0.0 && std::isnan(height_above(base, beside)))
        part = 1.0;
    };
    add(x > 0, cell - 1);
    add(x + 1 < width, cell + 1);
    add(y > 0, cell - width);
    add(y + 1 < surface_->raster.height, cell + width);
    return part;
  }

  /// By the slope between a cell's neighbours.
  static double height_at(const HeightRaster& raster, std::size_t cell, const glm::dvec2& place) {
    const glm::dvec2 at(static_cast<double>(cell % raster.width) + 0.5,
                        static_cast<double>(cell / raster.width) + 0.5);
    const glm::dvec2 off = (place - raster.corner) / raster.cell * glm::dvec2(1.0, -1.0) - at;
    double height = raster.values[cell];
    if (std::abs(off.x) > 1e-9)
      height += off.x * slope_at(raster, cell, 1, cell % raster.width, raster.width);
    if (std::abs(off.y) > 1e-9)
      height += off.y * slope_at(raster, cell, raster.width, cell / raster.width, raster.height);
    return height;
  }
  /// From cell to cell in the direction of `step`, of which it is cell `index` of `count`; 0 where neither neighbour has a height.
  static double slope_at(const HeightRaster& raster, std::size_t cell, std::size_t step, std::size_t index,
                         std::size_t count) {
    const double here = raster.values[cell];
    const double before = index > 0 ? raster.values[cell - step] : here;
    const double after = index + 1 < count ? raster.values[cell + step] : here;
    const double back = here - before, on = after - here;
    if (std::isnan(back) || index == 0) return std::isnan(on) ? 0.0 : on;
    return std::isnan(on) || index + 1 == count ? back : 0.5 * (back + on);
  }

  /// Sum of what a cell's neighbours lie above it; 0 where one is not known.
  static double bend_at(const HeightRaster& raster, std::size_t cell) {
    const std::size_t x = cell % raster.width, y = cell / raster.width;
    if (x == 0 || y == 0 || x + 1 == raster.width || y + 1 == raster.height) return 0.0;
    const double bend = raster.values[cell - 1] + raster.values[cell + 1] +
                        raster.values[cell - raster.width] + raster.values[cell + raster.width] -
                        4.0 * raster.values[cell];
    return std::isnan(bend) ? 0.0 : std::abs(bend);
  }

  /// How much the mean of max(height + noise, 0) is above max(height, 0).
  static double taken_at(double height, double deviation) {
    if (!(deviation > 0.0)) return 0.0;
    const double z = std::abs(height) / deviation;
    const double density = std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
    return deviation * (density - 0.5 * z * std::erfc(z / std::numbers::sqrt2));
  }

  const VolumeGround& ground_;
  std::vector<CellPart> parts_;
  std::optional<SeenHeights> surface_, earlier_;
};

double squared(double value) { return value * value; }

}  // namespace

std::vector<glm::dvec2> outline_of(const Scene& scene, const Region& region, const CutPlane& axes) {
  const double infinite = std::numeric_limits<double>::infinity();
  glm::dvec2 low(infinite), high(-infinite);
  for_each_splat(scene, [&](std::size_t, const SceneSplat& splat) {
    const glm::dvec3 center = splat.center_world();
    if (!region.holds(center)) return;
    const glm::dvec2 at(glm::dot(center, axes.right), glm::dot(center, axes.top));
    low = glm::min(low, at);
    high = glm::max(high, at);
  });
  if (!(low.x < high.x && low.y < high.y)) return {};
  return {low, {high.x, low.y}, high, {low.x, high.y}};
}

std::vector<CellPart> cell_parts(const glm::dvec2& corner, double cell, std::uint32_t width,
                                 std::uint32_t height, std::span<const glm::dvec2> outline) {
  std::vector<CellPart> parts;
  parts.reserve(std::size_t{width} * height);
  const Outline whole(outline.begin(), outline.end());
  for (std::uint32_t y = 0; y < height; ++y) {
    const double top = corner.y - y * cell;
    Outline row = clipped(clipped(whole, 1, top, true), 1, top - cell, false);
    for (std::uint32_t x = 0; x < width; ++x) {
      const double right = corner.x + (x + 1.0) * cell;
      parts.push_back(part_of(clipped(row, 0, right, true)));
      row = clipped(row, 0, right, false);
    }
  }
  return parts;
}

std::optional<VolumeFound> volume_over(const VolumeGround& ground, const VolumeBase& base,
                                       std::span<const VolumeBase> shifted) {
  VolumeGround known = ground;
  if (known.outline.empty()) {
    known.outline = outline_of(ground.scene, ground.region, ground.axes);
    known.is_all = true;
  }
  const double radius = disc_radius(ground.scene, ground.region), all = part_of(known.outline).area;
  if (!(radius > 0.0) || !(all > 0.0)) return {};
  const double cell = std::max(radius, std::sqrt(all / MOST_CELLS));
  const VolumeGrid grid(known, base, cell);
  const Sums sums = grid.sums(base), coarse = VolumeGrid(known, base, 2.0 * cell).sums(base);
  if (!(sums.area > 0.0)) return {};
  const VolumeGrid::Noise noise = grid.noise(base);
  // Net, cut, fill.
  std::array<double, 3> variances = noise.variances;
  for (const VolumeBase& other : shifted) {
    const Sums moved = grid.sums(other);
    variances[0] += squared(moved.cut - moved.fill - sums.cut + sums.fill);
    variances[1] += squared(moved.cut - sums.cut);
    variances[2] += squared(moved.fill - sums.fill);
  }
  // The coarse grid's cells at the border of what is known cover more.
  const double scale = coarse.area > 0.0 ? sums.area / coarse.area : 1.0;
  const std::array<double, 3> grids = {std::abs(scale * (coarse.cut - coarse.fill) - sums.cut + sums.fill),
                                       std::abs(scale * coarse.cut - sums.cut),
                                       std::abs(scale * coarse.fill - sums.fill)};
  // The mean of tangents within their radius, weighted by the raster's weights, lies off a curve by a sixteenth of the radius' square times
  // the curvature.
  const double bends = coarse.bends * squared(radius / (2.0 * cell)) / 16.0;
  const auto within = [&](std::size_t i) {
    const double random = OF_95_PERCENT * std::sqrt(variances.at(i));
    return std::hypot(random, grids.at(i), bends) + sums.holes + sums.borders.at(i) +
           (i == 0 ? 0.0 : noise.taken);
  };
  return VolumeFound{sums.cut, sums.fill, within(1), within(2), within(0), sums.area, sums.uncovered};
}

}  // namespace splatray
