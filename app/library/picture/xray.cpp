#include "app/library/picture/xray.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "engine/base/error.h"
#include "engine/base/rank.h"
#include "engine/base/srgb.h"
#include "engine/scene/scene_splat.h"
#include "preprocess/surface/neighbours.h"

namespace splatray {
namespace {

/// Pixels of the longer side of the image that decides what is light.
constexpr std::uint32_t COARSE_EDGE = 512;
constexpr double LIGHT_RANK = 0.4;   ///< rank of the amounts above 0 from which on it darkens,
constexpr double LIGHT_ABOVE = 1.2;  ///< times this: what most of the sheet has has no grain
constexpr std::size_t NEIGHBOURS = 8;
constexpr double SPREAD = 1.3;        ///< of a part, distances to its last neighbour
constexpr double LIGHT_SHADE = 0.92;  ///< as shown
constexpr double DOUBLINGS = 5.0;     ///< from light to black
/// Half the least width of a part, pixels: a narrower one would fall between the pixels' centres.
constexpr double LEAST_HALF_WIDTH = 1.0;
constexpr double FULL_PART = 0.5;  ///< of the light amount, from which a pixel is opaque
constexpr std::size_t REPORT_EVERY = 1U << 16U;

/// Pixels of a sheet, of any size.
struct Raster {
  glm::dvec2 corner;  ///< outer corner of the top left pixel, along Sheet::right and top
  double pixel;       ///< world
  std::uint32_t width, height;
};

/// A splat's projection: the places d from the centre, in pixels, y down, with d.inverse.d <= 1.
struct Footprint {
  glm::dvec2 center, half;  ///< half sides of the box around it
  double xx, xy, yy;        ///< of the inverse
  double peak;              ///< amount at the centre
};

/// What a splat stands for: how much surface, and how far around its centre that is spread.
struct SurfacePart {
  glm::dvec3 center;  ///< world
  glm::vec3 normal;
  float area_world, reach_world;
};

/// The projection of the disc over which a part is spread, widened to the least width.
Footprint footprint(const Sheet& sheet, const Raster& raster, const SurfacePart& part) {
  const double radius = static_cast<double>(part.reach_world) / raster.pixel;
  const double square = radius * radius, least = LEAST_HALF_WIDTH * LEAST_HALF_WIDTH;
  const glm::dvec3 normal(part.normal);
  const double nx = glm::dot(normal, sheet.right), ny = -glm::dot(normal, sheet.top);
  const double a = square * (1.0 - nx * nx) + least, b = -square * nx * ny,
               c = square * (1.0 - ny * ny) + least;
  const double determinant = a * c - b * b;
  const glm::dvec2 at = (sheet.on_paper(part.center) - raster.corner) / raster.pixel * glm::dvec2(1.0, -1.0);
  const double area = static_cast<double>(part.area_world) / (raster.pixel * raster.pixel);
  // The kernel (1 - d.inverse.d)^2 has the integral pi / 3 sqrt(determinant).
  const double peak = 3.0 * area / (std::numbers::pi * std::sqrt(determinant));
  return {at, {std::sqrt(a), std::sqrt(c)}, c / determinant, -b / determinant, a / determinant, peak};
}

/// The parts that the region holds. A splat's area follows from the distance to its eighth neighbour: of what it stands for, not of its
/// disc, which is larger beside thin sheets.
std::vector<SurfacePart> parts_of(const Scene& scene, const std::vector<Material>& materials,
                                  const Region& region) {
  Points points;
  for_each_splat(scene, [&](std::size_t, const SceneSplat& splat) {
    const glm::dvec3 center = splat.center_world();
    if (!region.holds(center)) return;
    if (splat.object() < materials.size() && (materials[splat.object()].flags & MATERIAL_HIDDEN) != 0) return;
    points.position.push_back(center);
    points.normal.emplace_back(splat.normal());
  });
  std::vector<SurfacePart> parts;
  if (points.position.size() <= NEIGHBOURS) return parts;
  BuildStats stats;
  const Cloud cloud = make_cloud(std::move(points), /*oriented=*/true, /*measured=*/false, stats);
  parts.resize(cloud.size());
  const Progress no_progress;
  NeighbourSearch(cloud, Sites::positions)
      .find_all(NEIGHBOURS, {"x-ray", no_progress}, [&](std::uint32_t i, std::span<Neighbour> nearest) {
        float most = 0.0F;
        for (const Neighbour& neighbour : nearest) most = std::max(most, neighbour.distance_squared());
        const double distance = std::sqrt(static_cast<double>(most)) * cloud.half_extent_world;
        parts[i] = {cloud.place_world(i), cloud.normal[i],
                    static_cast<float>(std::numbers::pi * distance * distance / NEIGHBOURS),
                    static_cast<float>(SPREAD * distance)};
      });
  return parts;
}

void add(const Footprint& splat, const Raster& raster, std::vector<float>& amounts) {
  const glm::dvec2 size(raster.width, raster.height);
  const glm::dvec2 low = glm::clamp(glm::floor(splat.center - splat.half), glm::dvec2(0.0), size);
  const glm::dvec2 high = glm::clamp(glm::ceil(splat.center + splat.half), glm::dvec2(0.0), size);
  for (auto y = static_cast<std::size_t>(low.y); y < static_cast<std::size_t>(high.y); ++y)
    for (auto x = static_cast<std::size_t>(low.x); x < static_cast<std::size_t>(high.x); ++x) {
      const double dx = static_cast<double>(x) + 0.5 - splat.center.x,
                   dy = static_cast<double>(y) + 0.5 - splat.center.y;
      const double left = 1.0 - (splat.xx * dx * dx + 2.0 * splat.xy * dx * dy + splat.yy * dy * dy);
      if (left > 0.0) amounts[y * raster.width + x] += static_cast<float>(splat.peak * left * left);
    }
}

/// Areas of surface for an area of paper.
std::vector<float> amounts_of(const std::vector<SurfacePart>& parts, const Sheet& sheet, const Raster& raster,
                              const std::function<bool(double)>& progress) {
  std::vector<float> amounts(std::size_t{raster.width} * raster.height);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i % REPORT_EVERY == 0 && progress &&
        !progress(static_cast<double>(i) / static_cast<double>(parts.size())))
      throw Error(ExitCode::interrupted, "rendering was interrupted");
    add(footprint(sheet, raster, parts[i]), raster, amounts);
  }
  return amounts;
}

/// The whole sheet in few pixels.
Raster coarse_raster(const Sheet& sheet) {
  const std::uint32_t longer = std::max(sheet.width, sheet.height);
  const double factor = std::max(1.0, static_cast<double>(longer) / COARSE_EDGE);
  const auto pixels = [factor](std::uint32_t side) {
    return static_cast<std::uint32_t>(std::ceil(side / factor));
  };
  return {sheet.corner, factor * sheet.pixel_world, pixels(sheet.width), pixels(sheet.height)};
}

/// The amount that is light; 0 where the sheet has nothing on it.
double light_amount(const std::vector<SurfacePart>& parts, const Sheet& sheet) {
  std::vector<double> amounts;
  for (const float amount : amounts_of(parts, sheet, coarse_raster(sheet), {}))
    if (amount > 0.0F) amounts.push_back(static_cast<double>(amount));
  return amounts.empty() ? 0.0 : LIGHT_ABOVE * value_at(amounts, LIGHT_RANK);
}

vec4 shaded(double amount, double light) {
  if (!(amount > 0.0)) return vec4(0.0F);
  const double part = std::clamp(std::log2(amount / light) / DOUBLINGS, 0.0, 1.0);
  const float alpha = static_cast<float>(std::min(amount / (FULL_PART * light), 1.0));
  return {vec3(srgb_to_linear(static_cast<float>(LIGHT_SHADE * (1.0 - part)))), alpha};
}

}  // namespace

Image xray_image(const Scene& scene, const std::vector<Material>& materials, const Sheet& sheet,
                 const PixelWindow& window, const Region& region,
                 const std::function<bool(double)>& progress) {
  const std::vector<SurfacePart> parts = parts_of(scene, materials, region);
  const double light = light_amount(parts, sheet);
  const Raster raster{sheet.corner + glm::dvec2(window.x, -static_cast<double>(window.y)) * sheet.pixel_world,
                      sheet.pixel_world, window.width, window.height};
  Image image{window.width, window.height, {}, {}};
  image.rgba.reserve(std::size_t{window.width} * window.height);
  for (const float amount : amounts_of(parts, sheet, raster, progress))
    image.rgba.push_back(shaded(static_cast<double>(amount), light));
  return image;
}

}  // namespace splatray
