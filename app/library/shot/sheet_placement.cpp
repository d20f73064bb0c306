#include "app/library/shot/sheet_placement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "app/library/cut/cut_hatch.h"
#include "app/library/cut/cut_join.h"
#include "app/library/cut/disc_radius.h"
#include "app/library/cut/floor_levels.h"
#include "app/library/measure/measure_words.h"
#include "engine/base/crs.h"
#include "engine/base/error.h"
#include "engine/base/number_text.h"
#include "engine/base/rank.h"
#include "engine/image/point_sample.h"
#include "engine/scene/scene_splat.h"

namespace splatray {
namespace {

constexpr double METRE_MM = 1000.0;
/// Paper around what is there, millimetres.
constexpr double MARGIN_MM = 4.0;
/// How far a straight part of a cut's line may be from the curve: a tenth of what is seen.
constexpr double CUT_TOLERANCE_MM = 0.005;
/// Hatching behind a surface whose back was not seen, on paper.
constexpr double STUB_MM = 2.0;
/// What is thicker between two surfaces is not taken for one wall.
constexpr double THICKEST_WALL_METRES = 1.5;
// Contours: cells of their heights on paper and how many at most, the deviation that smooths these, what is too short to say anything, and
// how far a straight part may be from the line.
constexpr double CONTOUR_CELL_MM = 0.5, CONTOUR_CELLS_MOST = 4e6, CONTOUR_SMOOTH_CELLS = 1.5;
constexpr double CONTOUR_LEAST_MM = 8.0, CONTOUR_TOLERANCE_MM = 0.05, CONTOUR_LEVELS_MOST = 1000.0;
/// Heights within a cell, in its sides, that are of one surface: a slope of 70 degrees is none of the ground's.
constexpr double CONTOUR_STEP = 2.75;
/// Pixels of a side that rays are numbered by.
constexpr double MOST_PIXELS = 1U << 20U;
/// Pixels of a sheet whatever is drawn on it: A2 at 300 dpi, about a minute of two cores for each sample.
constexpr double FREE_PIXELS = 4961.0 * 7016.0;
/// Further pixels for each splat. Where splats are 32 pixels apart, smaller pixels show the rims of discs and nothing else.
constexpr double SPLAT_PIXELS = 32.0 * 32.0;
constexpr double DEG = std::numbers::pi / 180.0;

/// The plan's right and top in the world, and up.
struct PlanAxes {
  glm::dvec3 east, north, up;

  explicit PlanAxes(const glm::dvec3& scene_up) {
    const glm::dmat3 axes = upright_axes(scene_up);
    east = axes[0];
    up = axes[1];
    north = -axes[2];
  }
  [[nodiscard]] glm::dvec3 world(double x, double y) const { return x * east + y * north; }
};

/// How the paper lies in the world.
void set_axes(const PlanAxes& plan, Sheet& sheet) {
  const std::vector<double>& place = sheet.asked.place;
  switch (sheet.asked.kind) {
    case SheetKind::plan:
    case SheetKind::atlas:
      sheet.right = plan.east;
      sheet.toward = plan.up;
      break;
    case SheetKind::section:
      sheet.right = glm::normalize(plan.world(place[2] - place[0], place[3] - place[1]));
      sheet.toward = glm::cross(sheet.right, plan.up);
      break;
    case SheetKind::elevation:
      sheet.toward = plan.world(std::sin(place[0] * DEG), std::cos(place[0] * DEG));
      sheet.right = glm::cross(plan.up, sheet.toward);
      break;
    case SheetKind::ortho:
      sheet.toward = -glm::normalize(glm::dvec3(place[0], place[1], place[2]));
      const glm::dvec3 across = glm::cross(plan.up, sheet.toward);
      sheet.right = glm::length(across) > 1e-9 ? glm::normalize(across) : plan.east;
      break;
  }
  sheet.top = glm::cross(sheet.toward, sheet.right);
  const glm::dvec3 x(1.0, 0.0, 0.0), y(0.0, 1.0, 0.0);
  sheet.north_up = glm::distance(sheet.right, x) < 1e-12 && glm::distance(sheet.top, y) < 1e-12;
}

void set_unit(Sheet& sheet) {
  sheet.unit_known = sheet.asked.unit_metres || describe_crs(sheet.crs).horizontal_metres > 0.0;
  sheet.unit_metres = require_unit_metres(sheet.crs, sheet.asked.unit_metres);
  sheet.pixel_world = sheet.pixel_mm() * sheet.asked.scale / METRE_MM / sheet.unit_metres;
}

/// How far what the sheet shows reaches along `toward`. From above that is all of the scene: the roof of a house that was flown over
/// hangs above the ground without walls. From a side it is what hangs together: what was seen through a window would hide the rest.
std::array<double, 2> shown_depths(const Scene& scene, const PointSample& all, const Sheet& sheet) {
  if (sheet.asked.kind != SheetKind::plan) return range_along(all.position, sheet.toward, 0.0);
  const glm::dvec3 low = scene.bounds_min_world, high = scene.bounds_max_world;
  std::array<double, 2> range{0.0, 0.0};
  for (int axis = 0; axis < 3; ++axis) {
    const double from = low[axis] * sheet.toward[axis], to = high[axis] * sheet.toward[axis];
    range[0] += std::min(from, to);
    range[1] += std::max(from, to);
  }
  return range;
}

/// Where the sheet begins and ends along `toward`; a section's also where it begins and ends along its line.
void set_depths(const PlanAxes& plan, const std::array<double, 2>& shown, Sheet& sheet) {
  const auto [low, high] = shown;
  const double slack = 1e-3 * (high - low) + sheet.pixel_world;
  sheet.near = high + slack;
  const std::vector<double>& place = sheet.asked.place;
  if (sheet.asked.kind == SheetKind::section) {
    const glm::dvec3 begin = plan.world(place[0], place[1]);
    sheet.near = glm::dot(begin, sheet.toward);
    sheet.origin.x = glm::dot(begin, sheet.right);
    sheet.cuts = true;
  } else if (sheet.asked.height) {
    sheet.near = *sheet.asked.height;
    sheet.cuts = true;
  }
  const double first = sheet.cuts ? sheet.near : high;
  sheet.far = sheet.asked.depth ? first - *sheet.asked.depth : low - slack;
}

/// Refuses a place on the paper, world units, at which float64 has no thousand steps a pixel: pixels would not lie where they
/// say, and the lines of the page's grid would coincide.
void require_resolved(double place, double pixel_world) {
  if (!(std::abs(place) * std::numeric_limits<double>::epsilon() * 1000.0 <= pixel_world))
    throw Error(ExitCode::usage, "the scene lies at coordinates of " + short_number(place) +
                                     ", which are too large for the sheet's pixels of " +
                                     short_number(pixel_world) +
                                     "; expected a scale of a larger number, or --keep-box");
}

void set_pixels(const PointSample& shown, std::size_t splats, Sheet& sheet) {
  const double margin = MARGIN_MM / sheet.pixel_mm() * sheet.pixel_world;
  std::array<double, 2> across = range_along(shown.position, sheet.right, 0.0);
  const std::array<double, 2> along = range_along(shown.position, sheet.top, 0.0);
  if (sheet.asked.kind == SheetKind::section) {
    const std::vector<double>& place = sheet.asked.place;
    across = {sheet.origin.x, sheet.origin.x + std::hypot(place[2] - place[0], place[3] - place[1])};
  } else {
    across = {across[0] - margin, across[1] + margin};
  }
  const double pixel = sheet.pixel_world;
  for (const double place : {across[0], across[1], along[0], along[1]}) require_resolved(place, pixel);
  sheet.corner.x = sheet.origin.x + pixel * std::floor((across[0] - sheet.origin.x) / pixel);
  sheet.corner.y = sheet.origin.y + pixel * std::ceil((along[1] + margin - sheet.origin.y) / pixel);
  const double width = std::ceil((across[1] - sheet.corner.x) / pixel);
  const double height = std::ceil((sheet.corner.y - along[0] + margin) / pixel);
  require_sheet_pixels(width, height, splats);
  sheet.width = std::max(static_cast<std::uint32_t>(width), 1U);
  sheet.height = std::max(static_cast<std::uint32_t>(height), 1U);
}

CutPlane cut_plane(const Sheet& sheet) { return {sheet.right, sheet.top, sheet.toward, sheet.near}; }

/// Cells of the raster that contours come from: half a millimetre of paper, larger where they would be too many.
HeightRaster raster_of(const Sheet& sheet) {
  const double width = sheet.width * sheet.pixel_world, height = sheet.height * sheet.pixel_world;
  const double cell =
      std::max(CONTOUR_CELL_MM * sheet.mm_world(), std::sqrt(width * height / CONTOUR_CELLS_MOST));
  return {sheet.corner,
          cell,
          static_cast<std::uint32_t>(std::ceil(width / cell)),
          static_cast<std::uint32_t>(std::ceil(height / cell)),
          {}};
}

/// Throws Error (usage) where there would be too many.
std::vector<Contour> sheet_contours(const Scene& scene, const Region& region, const Sheet& sheet) {
  const double interval = *sheet.asked.contours;
  HeightRaster raster = raster_of(sheet);
  fill_heights(scene, region, cut_plane(sheet), raster);
  const double step = CONTOUR_STEP * raster.cell;
  smooth_heights(CONTOUR_SMOOTH_CELLS, step, raster);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double value : raster.values)
    if (!std::isnan(value)) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  if ((high - low) / interval > CONTOUR_LEVELS_MOST)
    throw Error(ExitCode::usage, "found contours=" + number_text(interval) + " for heights from " +
                                     short_number(low) + " to " + short_number(high) + ", expected at most " +
                                     number_text(CONTOUR_LEVELS_MOST) + " contours one above the other");
  std::vector<Contour> contours;
  for (Contour& contour : contours_of(raster, interval, step)) {
    double length = 0.0;
    for (std::size_t i = 1; i < contour.curve.points.size(); ++i)
      length += glm::distance(contour.curve.points[i - 1], contour.curve.points[i]);
    if (length < CONTOUR_LEAST_MM * sheet.mm_world()) continue;
    contour.curve = simplified(contour.curve, CONTOUR_TOLERANCE_MM * sheet.mm_world());
    contours.push_back(std::move(contour));
  }
  return contours;
}

}  // namespace

void require_sheet_pixels(double width, double height, std::size_t splats) {
  const std::string found =
      "the sheet would be " + number_text(width) + " x " + number_text(height) + " pixels";
  const std::string instead = ": a scale of a larger number, fewer dpi, or --keep-box";
  if (!(width <= MOST_PIXELS && height <= MOST_PIXELS))
    throw Error(ExitCode::usage,
                found + ", expected at most " + number_text(MOST_PIXELS) + " a side" + instead);
  const double most = FREE_PIXELS + SPLAT_PIXELS * static_cast<double>(splats);
  if (width * height > most)
    throw Error(ExitCode::usage, found + " for a scene of " + std::to_string(splats) +
                                     " splats, expected at most " + number_text(std::round(most / 1e6)) +
                                     " million pixels" + instead);
}

Sheet make_sheet(const Scene& scene, const Request& request) {
  Sheet sheet;
  sheet.asked = *request.view.sheet;
  sheet.crs = scene.crs;
  sheet.up = request.look.up.value_or(scene.up);
  const PlanAxes plan(sheet.up);
  set_axes(plan, sheet);
  set_unit(sheet);
  const Region asked_region = region_of(request.view.region, sheet.up);
  Region region = asked_region;
  const PointSample all = main_parts(sample_points(scene, region));
  set_depths(plan, shown_depths(scene, all, sheet), sheet);
  for (const HalfSpace& plane : sheet.planes()) region.kept.push_back(plane);
  const PointSample shown = main_parts(sample_points(scene, region));
  if (shown.size() == 0)
    throw Error(ExitCode::usage, "the sheet has nothing of the scene on it, whose points lie between " +
                                     number_text(scene.bounds_min_world) + " and " +
                                     number_text(scene.bounds_max_world) +
                                     "; expected a cut that leaves some");
  set_pixels(shown, splat_count(scene), sheet);
  if (sheet.cuts && sheet.asked.weight_mm > 0.0)
    sheet.cut_curves = plane_cut(scene, asked_region, cut_plane(sheet), CUT_TOLERANCE_MM * sheet.mm_world());
  sheet.disc_world = disc_radius(scene, region);
  sheet.thickest_world = THICKEST_WALL_METRES / sheet.unit_metres;
  if (sheet.asked.hatch_mm > 0.0)
    sheet.hatch = cut_hatch(sheet.cut_curves, {sheet.asked.hatch_mm * sheet.mm_world(),
                                               STUB_MM * sheet.mm_world(), sheet.thickest_world});
  if (sheet.asked.contours) sheet.contours = sheet_contours(scene, region, sheet);
  if (sheet.asked.level)
    sheet.levels = floor_levels(scene, region, glm::normalize(sheet.up), sheet.unit_metres);
  return sheet;
}

}  // namespace splatray
