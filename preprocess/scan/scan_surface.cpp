#include "preprocess/scan/scan_surface.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "preprocess/scan/noise.h"
#include "preprocess/scan/sides.h"
#include "preprocess/scan/smooth.h"
#include "preprocess/scan/strays.h"
#include "preprocess/scan/survey.h"
#include "preprocess/surface/sharp.h"

namespace splatray {
namespace {

constexpr double NOISY = 0.05;  // noise (measure_noise) from which points are moved
constexpr double SHARP =
    0.05;  // share of points at creases that noise would have hidden: edges are what looks like it
constexpr std::size_t FEWEST = 1000;  // points that tell noise from shape
constexpr double SHORT = 0.95;        // of a smoothing radius, from which it is not reached

/// Leaves out what find_strays finds, in the survey too.
void drop_strays(Cloud& cloud, Survey& survey, BuildStats& stats) {
  const std::vector<Stray> strays = find_strays(cloud, survey);
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
  survey.keep(kept, number);
}

/// Creases and borders among the points, as `params` ask for; of points without radii, as others are discs already.
std::vector<SharpSide> find_sharp_sides(const Cloud& cloud, const Survey& survey, const BuildParams& params,
                                        const Stage& stage) {
  if (!params.clip || !cloud.radius.empty()) return {};
  return find_sharp(cloud, params.crease_degrees, survey.estimated, stage);
}

/// Where there are so many points that a radius which was asked for is not reached.
void note_reach(const Smoothed& smoothed, double asked_world, BuildStats& stats) {
  if (!(smoothed.reach_median_world < SHORT * asked_world)) return;
  std::array<char, 160> text{};
  std::snprintf(
      text.data(), text.size(),
      "smoothing by %.3g reaches %.3g (median), where there are about 64 neighbours; it takes no more",
      asked_world, smoothed.reach_median_world);
  stats.notes.emplace_back(text.data());
}

void count_sharp(const std::vector<SharpSide>& sharp, BuildStats& stats) {
  for (const SharpSide& side : sharp) {
    if (side.number > 0)
      ++stats.crease_copies;
    else
      ++(side.crease ? stats.creased : stats.bordered);
  }
}

}  // namespace

std::uint64_t find_scan_surface(Cloud& cloud, const glm::dvec3& up, const BuildParams& params,
                                const Stage& stage, BuildStats& stats) {
  Survey survey = survey_points(cloud, up, stage);
  drop_strays(cloud, survey, stats);
  const auto estimated = numbers_where(cloud.size(), [&](std::size_t i) { return survey.estimated[i] != 0; });
  const SidesFound sides = turn_to_sides(cloud, survey, estimated, up, stage);
  if (!estimated.empty()) ++stats.sides_by[static_cast<std::size_t>(sides.rung)];
  stats.sides_unsure += sides.unsure;
  const std::vector<SharpSide> sharp = find_sharp_sides(cloud, survey, params, stage);
  take_normals(cloud, sharp);
  const double noise = measure_noise(cloud, survey);
  stats.noise = std::max(stats.noise, noise);
  const bool sharply = static_cast<double>(sharp.size()) > SHARP * static_cast<double>(cloud.size());
  const bool noisy = noise > NOISY && estimated.size() >= FEWEST && !sharply;
  if (params.smooth_world > 0.0 || (params.smooth_world < 0.0 && noisy)) {
    const double radius = std::max(params.smooth_world, 0.0) / cloud.half_extent_world;
    survey.listed = {};
    const bool sided = estimated.empty() || sides.rung == SideRung::sensor;
    const Smoothed smoothed = smooth_points(cloud, survey, radius, sided, stage);
    if (smoothed.moved > 0) note_reach(smoothed, params.smooth_world, stats);
    stats.smoothed += smoothed.moved;
    stats.dropped_unsupported += smoothed.dropped;
    stats.moved_median_world = std::max(stats.moved_median_world, smoothed.moved_median_world);
  } else {
    take_sides(cloud, sharp);
    count_sharp(sharp, stats);
  }
  return estimated.size();
}

}  // namespace splatray
