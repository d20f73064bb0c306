#include "app/library/shot/sheet_set.h"

#include <algorithm>
#include <cmath>

#include "app/library/cut/floor_levels.h"
#include "app/library/measure/measure_words.h"
#include "app/library/shot/sheet_placement.h"
#include "engine/base/error.h"
#include "engine/base/number_text.h"
#include "engine/scene/scene_splat.h"

namespace splatray {
namespace {

/// Where plans of houses are cut, over tables and through windows.
constexpr double ABOVE_METRES = 1.2;
/// Heights of floors and cuts are round numbers of about a millimetre.
constexpr double STEP_METRES = 0.001;

Sheet sheet_of(const Scene& scene, const Request& request, const SheetRequest& asked) {
  Request one = request;
  one.view.sheet = asked;
  return make_sheet(scene, one);
}

std::vector<Sheet> floor_plans(const Scene& scene, const Request& request) {
  const SheetRequest& asked = *request.view.sheet;
  const glm::dvec3 up = request.look.up.value_or(scene.up);
  const double metres = require_unit_metres(scene.crs, asked.unit_metres),
               above = asked.above.value_or(ABOVE_METRES / metres);
  const Region region = region_of(request.view.region, up);
  std::vector<Sheet> plans;
  const double steps = std::pow(10.0, std::round(std::log10(metres / STEP_METRES)));  // in a unit
  for (const double found : storey_floors(scene, region, glm::normalize(up), metres, above)) {
    const double floor = std::round(found * steps) / steps;
    SheetRequest plan = asked;
    plan.kind = SheetKind::plan;
    plan.above.reset();
    plan.height = std::round((floor + above) * steps) / steps;
    plans.push_back(sheet_of(scene, request, plan));
    plans.back().floor = floor;
  }
  if (plans.empty())
    throw Error(ExitCode::usage, "found no floor, a level surface that faces up, among points between " +
                                     number_text(scene.bounds_min_world) + " and " +
                                     number_text(scene.bounds_max_world) +
                                     "; expected one for an atlas, or plan:z=HEIGHT");
  return plans;
}

/// Gives plans, whose pixels lie on one lattice, the rectangle that holds them all.
void unite(std::size_t splats, std::vector<Sheet>& plans) {
  glm::dvec2 low = plans.front().corner, high = low;  // along right and down
  for (const Sheet& plan : plans) {
    const glm::dvec2 end = plan.corner + glm::dvec2(plan.width, -double(plan.height)) * plan.pixel_world;
    low = {std::min(low.x, plan.corner.x), std::max(low.y, plan.corner.y)};
    high = {std::max(high.x, end.x), std::min(high.y, end.y)};
  }
  const glm::dvec2 pixels = glm::round(glm::abs(high - low) / plans.front().pixel_world);
  require_sheet_pixels(pixels.x, pixels.y, splats);
  for (Sheet& plan : plans) {
    plan.corner = low;
    plan.width = static_cast<std::uint32_t>(pixels.x);
    plan.height = static_cast<std::uint32_t>(pixels.y);
  }
}

}  // namespace

SheetSet make_sheet_set(const Scene& scene, const Request& request) {
  const SheetRequest& asked = *request.view.sheet;
  if (asked.kind == SheetKind::atlas) {
    SheetSet atlas{floor_plans(scene, request), true};
    unite(splat_count(scene), atlas.sheets);
    return atlas;
  }
  SheetSet views;
  SheetRequest first = asked;
  first.others.clear();
  views.sheets.push_back(sheet_of(scene, request, first));
  for (const SheetRequest& other : asked.others) views.sheets.push_back(sheet_of(scene, request, other));
  return views;
}

}  // namespace splatray
