#include "app/library/cut/height_raster.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/scene/scene_splat.h"

namespace splatray {
namespace {

/// The least cosine between a disc and the raster: of a wall there is no height.
constexpr double LEAST_COSINE = 0.1;

/// A disc over the raster, in cells, its heights in world units.
struct Disc {
  glm::dvec2 center;
  double height, radius;  ///< radius in cells
  glm::dvec2 slope;       ///< of its heights, world units a cell
  double reach;           ///< world units: the radius
};

/// Calls visit(cell, height, weight) for the cells whose centres the disc covers.
template <typename Visit>
void for_each_cell(const Disc& disc, const HeightRaster& raster, const Visit& visit) {
  const glm::dvec2 size(raster.width, raster.height), reach(disc.radius);
  const glm::dvec2 low = glm::clamp(glm::floor(disc.center - reach), glm::dvec2(0.0), size);
  const glm::dvec2 high = glm::clamp(glm::ceil(disc.center + reach), glm::dvec2(0.0), size);
  for (auto y = static_cast<std::size_t>(low.y); y < static_cast<std::size_t>(high.y); ++y)
    for (auto x = static_cast<std::size_t>(low.x); x < static_cast<std::size_t>(high.x); ++x) {
      const glm::dvec2 to =
          glm::dvec2(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5) - disc.center;
      const double left = 1.0 - glm::dot(to, to) / (disc.radius * disc.radius);
      if (left > 0.0) visit(y * raster.width + x, disc.height + glm::dot(to, disc.slope), left * left);
    }
}

/// Calls visit(Disc) for the scene's discs that have a height.
template <typename Visit>
void for_each_disc(const Scene& scene, const Region& region, const CutPlane& plane,
                   const HeightRaster& raster, const Visit& visit) {
  for_each_splat(scene, [&](std::size_t, const SceneSplat& splat) {
    const glm::dvec3 center = splat.center_world();
    if (!region.holds(center)) return;
    const glm::dvec3 normal = splat.normal();
    const double cosine = glm::dot(normal, plane.toward);
    if (std::abs(cosine) < LEAST_COSINE) return;
    const glm::dvec2 at(glm::dot(center, plane.right), glm::dot(center, plane.top));
    const glm::dvec2 slope(glm::dot(normal, plane.right), glm::dot(normal, plane.top));
    const double radius = splat.radius_world();
    // At least a cell across, so that discs smaller than cells fall between none.
    visit(Disc{(at - raster.corner) / raster.cell * glm::dvec2(1.0, -1.0), glm::dot(center, plane.toward),
               std::max(radius / raster.cell, 1.0), -slope / cosine * raster.cell * glm::dvec2(1.0, -1.0),
               radius});
  });
}

}  // namespace

void fill_heights(const Scene& scene, const Region& region, const CutPlane& plane, HeightRaster& raster) {
  const std::size_t cells = std::size_t{raster.width} * raster.height;
  std::vector<double> highest(cells, -std::numeric_limits<double>::infinity()), sums(cells), weights(cells);
  for_each_disc(scene, region, plane, raster, [&](const Disc& disc) {
    for_each_cell(disc, raster, [&](std::size_t cell, double height, double) {
      highest[cell] = std::max(highest[cell], height);
    });
  });
  for_each_disc(scene, region, plane, raster, [&](const Disc& disc) {
    for_each_cell(disc, raster, [&](std::size_t cell, double height, double weight) {
      if (height < highest[cell] - disc.reach) return;
      sums[cell] += weight * height;
      weights[cell] += weight;
    });
  });
  raster.values.resize(cells);
  for (std::size_t i = 0; i < cells; ++i)
    raster.values[i] = weights[i] > 0.0 ? sums[i] / weights[i] : std::numeric_limits<double>::quiet_NaN();
}

void smooth_heights(double deviation, double step, HeightRaster& raster) {
  const auto reach = static_cast<std::int64_t>(std::ceil(2.5 * deviation));
  // Along rows, then along columns.
  for (const bool is_row : {true, false}) {
    const std::vector<double> before = raster.values;
    for (std::int64_t y = 0; y < raster.height; ++y)
      for (std::int64_t x = 0; x < raster.width; ++x) {
        const double own = before[static_cast<std::size_t>(y * raster.width + x)];
        if (std::isnan(own)) continue;
        double sum = 0.0, weights = 0.0;
        for (std::int64_t by = -reach; by <= reach; ++by) {
          const std::int64_t column = is_row ? x + by : x, row = is_row ? y : y + by;
          if (column < 0 || row < 0 || column >= raster.width || row >= raster.height) continue;
          const double other = before[static_cast<std::size_t>(row * raster.width + column)];
          const auto cells = static_cast<double>(std::abs(by));
          if (!(std::abs(other - own) <= step * cells)) continue;
          const double weight = std::exp(-0.5 * cells * cells / (deviation * deviation));
          sum += weight * other;
          weights += weight;
        }
        raster.values[static_cast<std::size_t>(y * raster.width + x)] = sum / weights;
      }
  }
}

}  // namespace splatray
