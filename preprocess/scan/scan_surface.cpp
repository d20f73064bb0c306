#include "preprocess/scan/scan_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "preprocess/base/select.h"
#include "preprocess/scan/grid/grid_surface.h"
#include "preprocess/scan/kind.h"
#include "preprocess/scan/line/lines.h"
#include "preprocess/scan/noise.h"
#include "preprocess/scan/sides.h"
#include "preprocess/scan/smooth/layers.h"
#include "preprocess/scan/smooth/smooth.h"
#include "preprocess/scan/station.h"
#include "preprocess/scan/strays.h"
#include "preprocess/scan/survey.h"
#include "preprocess/surface/sharp.h"

namespace splatray {
namespace {

constexpr double LEAST_NOISE = 0.02;  // of the distance to the 8th place: less is hidden by what discs blend
constexpr double SHARP =
    0.05;  // share of points at creases that noise would have hidden: edges are what looks like it
constexpr double WHOLE_CLOUD = 4.0;  // a radius, cloud coordinates, that reaches all points from each
// Radius of discs on no surface over the distance to the 6th place.
constexpr float LEAVES = 0.4F, CLUTTER = 0.3F;

/// Leaves out what find_strays finds, in the survey too.
void drop_strays(Cloud& cloud, const GridSurface& grids, Survey& survey, BuildStats& stats) {
  std::vector<Stray> strays = find_strays(cloud, survey, grids);
  // The next ring may be far off: what is on a line is not alone.
  const auto alone = numbers_where(cloud.size(), [&](std::size_t i) { return strays[i] == Stray::isolated; });
  for (const std::uint32_t i : points_on_lines(cloud, survey, alone)) strays[i] = Stray::no;
  const auto count = [&](Stray kind) {
    return static_cast<std::uint64_t>(std::count(strays.begin(), strays.end(), kind));
  };
  const std::uint64_t isolated = count(Stray::isolated), mixed = count(Stray::mixed);
  if (isolated + mixed == 0) return;
  stats.dropped_isolated += isolated;
  stats.dropped_mixed += mixed;
  const auto kept = numbers_where(cloud.size(), [&](std::size_t i) { return strays[i] == Stray::no; });
  std::vector<std::uint32_t> number(cloud.size(), NO_CELL);  // after the others are gone
  for (std::uint32_t n = 0; n < kept.size(); ++n) number[kept[n]] = n;
  keep_points(cloud, kept);
  survey.keep(cloud, kept, number);
}

/// Finds what points are part of; those at creases, which bend the planes around them, and on lines that make up a surface are of
/// surfaces.
void sort_kinds(Cloud& cloud, Survey& survey, std::vector<SharpSide>& sharp, BuildStats& stats) {
  for (const SharpSide& side : sharp)
    if (side.crease && !survey.flatness.empty()) survey.flatness[side.point] = 0.0F;
  cloud.kind = find_kinds(cloud, survey);
  if (!cloud.kind.empty() && !cloud.ellipse.empty())
    for (std::size_t i = 0; i < cloud.size(); ++i)
      if (cloud.is_ellipse(i) || (!cloud.radius_most.empty() && std::isfinite(cloud.radius_most[i])))
        cloud.kind[i] = ScanKind::surface;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (survey.estimated[i] == 0) continue;
    ++stats.kinds[static_cast<std::size_t>(cloud.kind.empty() ? ScanKind::surface : cloud.kind[i])];
  }
  // What a line's own points say of its ends and sides is not of the surface.
  std::erase_if(sharp, [&](const SharpSide& side) {
    return !cloud.on_surface(side.point) || cloud.is_ellipse(side.point);
  });
}

/// Creases and borders among the points, as `params` ask for; of points without radii, as others are discs already.
std::vector<SharpSide> find_sharp_sides(const Cloud& cloud, const Survey& survey, const BuildParams& params,
                                        const Stage& stage) {
  if (!params.clip || !cloud.radius.empty()) return {};
  return find_sharp(cloud, *survey.near, params.crease_degrees, survey.estimated, stage).sides;
}

/// Turns the planes at creases and borders to the sides of their points' normals.
void turn_with_points(const Cloud& cloud, std::vector<SharpSide>& sharp) {
  for (SharpSide& side : sharp)
    if (glm::dot(side.normal, cloud.normal[side.point]) < 0.0F) side.normal = -side.normal;
}

void count_sharp(const std::vector<SharpSide>& sharp, BuildStats& stats) {
  for (const SharpSide& side : sharp) {
    if (side.number > 0)
      ++stats.crease_copies;
    else
      ++(side.crease ? stats.creased : stats.bordered);
  }
}

/// The surface that grids determine.
GridSurface find_grids(Cloud& cloud, const BuildParams& params, const Stage& stage, BuildStats& stats) {
  GridSurface grids = find_grid_surface(cloud, params.smooth_world < 0.0, stage);
  stats.dropped_mixed += grids.mixed;
  stats.smoothed += grids.moved;
  stats.moved_median_world = std::max(stats.moved_median_world, grids.moved_median_world);
  stats.noise = std::max(stats.noise, grids.noise);
  return grids;
}

/// Writes what was found of each station's points into it; a cloud without stations gets one.
void note_quality(Cloud& cloud, const std::vector<double>& steps, const std::vector<double>& noise) {
  cloud.stations.resize(std::max<std::size_t>(cloud.stations.size(), 1));
  for (std::size_t s = 0; s < cloud.stations.size(); ++s) {
    cloud.stations[s].step_world = steps[s];
    if (s < noise.size()) cloud.stations[s].noise_world = noise[s];
  }
}

/// Raises the noise of stations where it does not explain how far points were moved: they lay in layers that became one, or moved
/// much farther (of simulated tripods' noise 1.2 times as far as measured).
void note_moved(Cloud& cloud, const Smoothed& smoothed) {
  constexpr double UNEXPLAINED = 2.0;
  // Two layers that became one lie off by m each, in opposite ways, so their distance by 2 m. Its 95 % hold that where the noise is
  // 1.25 m: 1.96 sqrt(2) 1.25 m / sqrt(3), as surface_point.cpp has it.
  constexpr double OF_MOVED = 1.25;
  const double moved = smoothed.moved_median_world;
  for (Station& station : cloud.stations)
    if (smoothed.layered || moved > UNEXPLAINED * station.noise_world)
      station.noise_world = std::max(station.noise_world, OF_MOVED * moved);
}

/// Looks at all points once; given normals that are noisy, as those of a scanner's grid are, are estimated anew from all scans
/// together, on their sides.
Survey look_at(Cloud& cloud, const glm::dvec3& up, const BuildParams& params, const Stage& stage) {
  Survey survey = survey_points(cloud, up, stage);
  const auto given = numbers_where(cloud.size(), [&](std::size_t i) { return survey.estimated[i] == 0; });
  if (params.smooth_world >= 0.0 || !is_noise(pair_heights(cloud, survey, given), false)) return survey;
  std::vector<glm::vec3> sides(cloud.size());
  for (const std::uint32_t i : given) std::swap(sides[i], cloud.normal[i]);
  survey = {};
  survey = survey_points(cloud, up, stage);
  survey.sided.resize(cloud.size());
  for (const std::uint32_t i : given) {
    survey.sided[i] = 1;
    if (glm::dot(sides[i], cloud.normal[i]) < 0.0F) cloud.normal[i] = -cloud.normal[i];
  }
  return survey;
}

/// Those of surfaces whose normals were not given.
std::vector<std::uint8_t> find_movable(const Cloud& cloud, const Survey& survey) {
  std::vector<std::uint8_t> movable = survey.estimated;
  for (std::size_t i = 0; i < cloud.size(); ++i) movable[i] = movable[i] != 0 && cloud.on_surface(i) ? 1 : 0;
  return movable;
}

/// Lets those around which points are so far from each other that noise hardly shows move only where what lies around is flat within
/// noise: another move would level what they are of.
void keep_far_relief(const Survey& survey, double noise_length, std::vector<std::uint8_t>& movable) {
  const auto far = static_cast<float>(noise_length / LEAST_NOISE);
  tbb::parallel_for(std::size_t{0}, movable.size(), [&](std::size_t i) {
    std::array<float, Survey::LISTED> reach;
    const auto around = survey.around(i);
    std::transform(around.begin(), around.end(), reach.begin(),
                   [&](std::uint32_t j) { return survey.reach[j]; });
    if (movable[i] != 0 && median_of(std::span<float>(reach)) > far) movable[i] = MOVES_WHERE_FLAT;
  });
}

/// Moves points onto the surface that they are of: all as far as `params` ask for, else by their grids or by what is near.
void move_to_surface(Cloud& cloud, Survey& survey, const BuildParams& params, SmoothParams how,
                     const Stage& stage, BuildStats& stats) {
  const bool asked = params.smooth_world > 0.0;
  how.radius = std::clamp(params.smooth_world / cloud.half_extent_world, 0.0, WHOLE_CLOUD);
  std::vector<std::uint8_t> movable = find_movable(cloud, survey);
  Smoothed smoothed;
  if (!asked) smoothed = smooth_by_grids(cloud, movable, how.noise, stage);
  if (smoothed.moved == 0) {
    if (asked)
      for (std::size_t i = 0; i < cloud.size(); ++i) movable[i] = cloud.on_surface(i) ? 1 : 0;
    else
      keep_far_relief(survey, how.noise_length, movable);
    survey.near = {};
    how.moves = std::move(movable);
    smoothed = smooth_points(cloud, std::move(survey), how, stage);
  }
  stats.smoothed += smoothed.moved;
  stats.dropped_unsupported += smoothed.dropped;
  stats.moved_median_world = std::max(stats.moved_median_world, smoothed.moved_median_world);
  note_moved(cloud, smoothed);
}

/// Those of these points whose sides no given normal says: `points` themselves where that is all, else put into `some`.
const std::vector<std::uint32_t>& keep_unsided(const Survey& survey, const std::vector<std::uint32_t>& points,
                                               std::vector<std::uint32_t>& some) {
  if (survey.sided.empty()) return points;
  std::copy_if(points.begin(), points.end(), std::back_inserter(some),
               [&](std::uint32_t i) { return survey.sided[i] == 0; });
  return some;
}

/// Turns these points' normals, and the planes at creases and borders, to their sides.
SidesFound find_sides(Cloud& cloud, const Survey& survey, const std::vector<std::uint32_t>& points,
                      const glm::dvec3& up, const Stage& stage, std::vector<SharpSide>& sharp) {
  const SidesFound sides = turn_to_sides(cloud, survey, points, up, stage);
  turn_with_points(cloud, sharp);
  take_normals(cloud, sharp);
  return sides;
}

/// part_layers where noise would join them, and of walls alone, of which nothing says yet which side is which.
std::vector<float> find_layers(Cloud& cloud, const Survey& survey, const std::vector<std::uint32_t>& points,
                               const SidesFound& sides, bool noisy, const Stage& stage) {
  const bool wall = sides.rung == SideRung::up && !sides.terrain;
  return wall || noisy ? part_layers(cloud, survey, points, sides.rung == SideRung::votes, stage)
                       : std::vector<float>{};
}

/// How many normals were not given.
std::uint64_t count_unknown(const Survey& survey) {
  const auto estimated = std::count(survey.estimated.begin(), survey.estimated.end(), 1);
  const auto sided = std::count(survey.sided.begin(), survey.sided.end(), 1);
  return static_cast<std::uint64_t>(estimated - sided);
}

}  // namespace

std::uint64_t find_scan_surface(Cloud& cloud, const glm::dvec3& up, const BuildParams& params,
                                const Stage& stage, BuildStats& stats) {
  if (!params.keep_strays) stats.dropped_duplicates += drop_copies(cloud);
  const std::vector<double> steps = station_step_world(cloud);
  const GridSurface grids = params.keep_strays ? GridSurface{} : find_grids(cloud, params, stage, stats);
  const bool all_in_grids = grids.points > 0 && grids.points == cloud.size();
  if (all_in_grids && !(params.smooth_world > 0.0)) {
    note_quality(cloud, steps, {});
    note_moved(cloud, {.moved = grids.moved, .moved_median_world = grids.moved_median_world});
    if (grids.normals > 0) ++stats.sides_by[static_cast<std::size_t>(SideRung::sensor)];
    return grids.normals;
  }
  Survey survey = look_at(cloud, up, params, stage);
  if (!params.keep_strays) drop_strays(cloud, grids, survey, stats);
  std::vector<LinePlace> lines = find_lines(cloud, survey, stage);
  stats.station_explained = std::max(stats.station_explained, find_station(cloud, survey, lines, up));
  lay_line_surfaces(cloud, survey, params.clip && cloud.radius.empty(), std::move(lines));
  std::vector<SharpSide> sharp = find_sharp_sides(cloud, survey, params, stage);
  sort_kinds(cloud, survey, sharp, stats);
  const auto estimated = numbers_where(
      cloud.size(), [&](std::size_t i) { return survey.estimated[i] != 0 && cloud.on_surface(i); });
  std::vector<std::uint32_t> some;
  const std::vector<std::uint32_t>& unsided = keep_unsided(survey, estimated, some);
  const SidesFound sides = find_sides(cloud, survey, unsided, up, stage, sharp);
  if (!estimated.empty()) ++stats.sides_by[static_cast<std::size_t>(sides.rung)];
  stats.sides_unsure += sides.unsure;
  const PairHeights heights = pair_heights(cloud, survey, estimated);
  const bool sharply = static_cast<double>(sharp.size()) > SHARP * static_cast<double>(cloud.size());
  const bool noisy = is_noise(heights, sides.terrain) && !sharply;
  SmoothParams how{.sided = unsided.empty() || sides.rung == SideRung::sensor,
                   .noise_length = heights.near_length};
  if (!how.sided) how.sheet_end = find_layers(cloud, survey, unsided, sides, noisy, stage);
  how.noise = measure_noise(cloud, survey);
  if (!cloud.kind.empty()) {
    const bool terrain = sides.rung == SideRung::up || sides.rung == SideRung::track;
    make_scatter_discs(cloud, survey, up, !terrain && is_room(cloud, survey, up) ? CLUTTER : LEAVES);
  }
  stats.noise = std::max(stats.noise, how.noise);
  note_quality(cloud, steps, station_noise_world(cloud, survey));
  note_moved(cloud, {.moved = grids.moved, .moved_median_world = grids.moved_median_world});
  const std::uint64_t unknown = count_unknown(survey);
  if (params.smooth_world > 0.0 || (params.smooth_world < 0.0 && noisy)) {
    move_to_surface(cloud, survey, params, std::move(how), stage, stats);
  } else {
    take_sides(cloud, sharp);
    count_sharp(sharp, stats);
    if (sharp.empty() && cloud.kind.empty() && survey.near->search().has_all())
      cloud.near = std::move(survey.near);
  }
  return unknown + grids.normals;
}

}  // namespace splatray
