#include "app/library/cut/height_raster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

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

/// What the discs that count in a cell add up to: those within their radius of the highest.
struct CellSums {
  std::vector<double> highest, sums, weights;

  CellSums(const Scene& scene, const Region& region, const CutPlane& plane, const HeightRaster& raster)
      : highest(std::size_t{raster.width} * raster.height, -std::numeric_limits<double>::infinity()),
        sums(highest.size()),
        weights(highest.size()) {
    for_each_disc(scene, region, plane, raster, [&](const Disc& disc) {
      for_each_cell(disc, raster, [&](std::size_t cell, double height, double) {
        highest[cell] = std::max(highest[cell], height);
      });
    });
    for_each_disc(scene, region, plane, raster, [&](const Disc& disc) {
      for_each_cell(disc, raster, [&](std::size_t cell, double height, double weight) {
        if (!counts(disc, cell, height)) return;
        sums[cell] += weight * height;
        weights[cell] += weight;
      });
    });
  }
  [[nodiscard]] bool counts(const Disc& disc, std::size_t cell, double height) const {
    return height >= highest[cell] - disc.reach;
  }
};

/// What a disc's height differs from the mean of the others in the cell of its centre; nothing where it is alone there.
std::optional<double> residual_of(const Disc& disc, const HeightRaster& raster, const CellSums& cells) {
  constexpr double MOST_OWN = 0.95;  // share of the cell's weight
  const glm::dvec2 at = glm::floor(disc.center);
  if (at.x < 0.0 || at.y < 0.0 || at.x >= raster.width || at.y >= raster.height) return {};
  const std::size_t cell = static_cast<std::size_t>(at.y) * raster.width + static_cast<std::size_t>(at.x);
  const glm::dvec2 to = at + 0.5 - disc.center;
  const double left = 1.0 - glm::dot(to, to) / (disc.radius * disc.radius);
  const double height = disc.height + glm::dot(to, disc.slope);
  if (!(left > 0.0) || !cells.counts(disc, cell, height)) return {};
  const double own = left * left / cells.weights[cell];
  if (own > MOST_OWN) return {};
  return (height - cells.sums[cell] / cells.weights[cell]) / (1.0 - own);
}

}  // namespace

void fill_heights(const Scene& scene, const Region& region, const CutPlane& plane, HeightRaster& raster) {
  const CellSums cells(scene, region, plane, raster);
  raster.values.resize(cells.sums.size());
  for (std::size_t i = 0; i < raster.values.size(); ++i)
    raster.values[i] =
        cells.weights[i] > 0.0 ? cells.sums[i] / cells.weights[i] : std::numeric_limits<double>::quiet_NaN();
}

HeightNoise height_noise(const Scene& scene, const Region& region, const CutPlane& plane,
                         const HeightRaster& raster, const std::vector<std::vector<double>>& factors,
                         double noise_world) {
  const CellSums cells(scene, region, plane, raster);
  const std::size_t count = factors.size();
  // Squares of the discs' shares in the sums: of all, of those whose residual is known, and these times its square.
  std::vector<double> all(count), known(count), weighed(count), shares(count);
  double squares = 0.0;
  std::size_t residuals = 0;
  for_each_disc(scene, region, plane, raster, [&](const Disc& disc) {
    std::fill(shares.begin(), shares.end(), 0.0);
    bool has_share = false;
    for_each_cell(disc, raster, [&](std::size_t cell, double height, double weight) {
      if (!cells.counts(disc, cell, height)) return;
      for (std::size_t i = 0; i < count; ++i) shares[i] += factors[i][cell] * weight / cells.weights[cell];
      has_share = has_share || factors.front()[cell] != 0.0;
    });
    if (!has_share) return;
    const std::optional<double> residual = residual_of(disc, raster, cells);
    if (residual) squares += *residual * *residual;
    residuals += residual ? 1 : 0;
    for (std::size_t i = 0; i < count; ++i) {
      const double square = shares[i] * shares[i];
      all[i] += square;
      if (residual) known[i] += square;
      if (residual) weighed[i] += square * *residual * *residual;
    }
  });
  HeightNoise noise{residuals > 0 ? std::sqrt(squares / static_cast<double>(residuals)) : 0.0, {}};
  for (std::size_t i = 0; i < count; ++i)
    noise.variances.push_back(std::max(weighed[i] + (all[i] - known[i]) * noise.residual * noise.residual,
                                       all[i] * noise_world * noise_world));
  return noise;
}

std::vector<double> fill_holes(HeightRaster& raster) {
  constexpr std::array<std::array<int, 2>, 8> WAYS = {
      {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
  const std::vector<double> before = raster.values;
  const auto width = static_cast<std::int64_t>(raster.width),
             height = static_cast<std::int64_t>(raster.height);
  const auto value_at = [&](std::int64_t x, std::int64_t y) {
    return before[static_cast<std::size_t>(y * width + x)];
  };
  std::vector<double> spreads(before.size());
  for (std::int64_t y = 0; y < height; ++y)
    for (std::int64_t x = 0; x < width; ++x) {
      if (!std::isnan(value_at(x, y))) continue;
      double low = std::numeric_limits<double>::infinity(), high = -low, sum = 0.0, weights = 0.0;
      std::size_t met = 0;
      for (const auto& [dx, dy] : WAYS) {
        std::int64_t cx = x + dx, cy = y + dy;
        while (cx >= 0 && cy >= 0 && cx < width && cy < height && std::isnan(value_at(cx, cy))) {
          cx += dx;
          cy += dy;
        }
        if (cx < 0 || cy < 0 || cx >= width || cy >= height) break;
        const double found = value_at(cx, cy);
        const double weight = 1.0 / std::hypot(static_cast<double>(cx - x), static_cast<double>(cy - y));
        low = std::min(low, found);
        high = std::max(high, found);
        sum += weight * found;
        weights += weight;
        ++met;
      }
      const auto cell = static_cast<std::size_t>(y * width + x);
      const bool is_hole = met == WAYS.size();
      spreads[cell] =
          is_hole ? 0.5 * (high - low) / std::numbers::sqrt3 : std::numeric_limits<double>::quiet_NaN();
      if (is_hole) raster.values[cell] = sum / weights;
    }
  return spreads;
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
