#include "preprocess/scan/kind.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "engine/scene/splat.h"
#include "preprocess/base/parallel.h"
#include "preprocess/base/select.h"
#include "preprocess/base/unit_or_zero.h"
#include "preprocess/surface/radius.h"
#include "preprocess/surface/voronoi.h"

namespace splatray {
namespace {

constexpr float BESIDE_SCATTER = 1.0F;  // most of a surface's radius next to what is none, in the same units
constexpr int VOTING_ROUNDS = 2;        // in which points do as most around them
constexpr double UPWARDS = 0.7;         // of `up`, beside the unit gradient of the density
// Powers of how many points a mean is of. k of them lie k^(1/3) times nearer to each other in all directions than such means do, so that their
// discs have k^(1/3) times the area of the mean's.
constexpr float OF_COVER = 1.0F / 6.0F;
// Small leaves take more of each other's light than large ones (tests/bench/ideas.md).
constexpr float OF_SHADE = 1.0F / 12.0F;

ScanKind kind_of(const Survey& survey, std::uint32_t point) {
  if (survey.flatness[point] == std::numeric_limits<float>::infinity()) return ScanKind::line;
  const auto around = survey.around(point);
  const auto rough = std::count_if(around.begin(), around.end(),
                                   [&](std::uint32_t i) { return survey.flatness[i] > Survey::FLAT; });
  const bool own = survey.flatness[point] > Survey::FLAT;
  const auto votes = static_cast<std::size_t>(rough) + (own ? 1 : 0);
  return 2 * votes > Survey::LISTED + 1 ? ScanKind::scatter : ScanKind::surface;
}

float ring_distance(const Cloud& cloud, const Survey& survey, std::uint32_t point) {
  const float distance = glm::distance(cloud.coord[point], cloud.coord[survey.around(point, EVEN_RING - 1)]);
  return distance > 0.0F ? distance : survey.reach[point];  // a stray that is gone stood there
}

/// Gives the mean of `count` points on no surface, whose disc is as a point's would be, the cover and the light of all of their discs.
void show_as_many(Cloud& cloud, std::size_t i, float count) {
  cloud.radius[i] *= std::pow(count, OF_COVER);
  if (!cloud.color.empty())
    cloud.color[i] = pack_color(unpack_color(cloud.color[i]) * std::pow(count, -OF_SHADE));
}

/// Surfaces of a few points amid scatter are scatter too, and the reverse.
std::vector<ScanKind> as_most_around(const std::vector<ScanKind>& kinds, const Survey& survey) {
  std::vector<ScanKind> next(kinds.size());
  tbb::parallel_for(std::size_t{0}, kinds.size(), [&](std::size_t i) {
    next[i] = kinds[i];
    if (survey.estimated[i] == 0 || kinds[i] == ScanKind::line) return;
    const auto around = survey.around(static_cast<std::uint32_t>(i));
    const auto scatter = std::count_if(around.begin(), around.end(),
                                       [&](std::uint32_t j) { return kinds[j] == ScanKind::scatter; });
    const auto votes = static_cast<std::size_t>(scatter) + (kinds[i] == ScanKind::scatter ? 1 : 0);
    next[i] = 2 * votes > Survey::LISTED + 1 ? ScanKind::scatter : ScanKind::surface;
  });
  return next;
}

/// ASPRS's codes of vegetation that has crowns, and of what lies under them.
bool is_crown(double code) { return code == 4.0 || code == 5.0; }
bool is_firm(double code) { return code == 2.0 || code == 6.0; }

/// Crowns are scatter where the file's classes tell them from ground and buildings.
void follow_classes(const Cloud& cloud, const Survey& survey, std::vector<ScanKind>& kinds) {
  constexpr std::size_t TOLD = 100;  // one in so many points is firm: a file of one class tells nothing
  const Column* column = find_column(cloud.columns, COLUMN_CLASS);
  if (column == nullptr || column->size() != cloud.size()) return;
  std::size_t firm = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) firm += is_firm(column->number(i)) ? 1 : 0;
  if (firm * TOLD < cloud.size()) return;
  tbb::parallel_for(std::size_t{0}, kinds.size(), [&](std::size_t i) {
    if (survey.estimated[i] != 0 && kinds[i] == ScanKind::surface && is_crown(column->number(i)))
      kinds[i] = ScanKind::scatter;
  });
}

}  // namespace

std::vector<ScanKind> find_kinds(const Cloud& cloud, const Survey& survey) {
  if (cloud.size() < FEWEST_TELLING) return {};
  std::vector<ScanKind> kinds(cloud.size());
  tbb::parallel_for(std::size_t{0}, kinds.size(), [&](std::size_t i) {
    const bool estimated = survey.estimated[i] != 0;
    kinds[i] = estimated ? kind_of(survey, static_cast<std::uint32_t>(i)) : ScanKind::surface;
  });
  for (int round = 0; round < VOTING_ROUNDS; ++round) kinds = as_most_around(kinds, survey);
  follow_classes(cloud, survey, kinds);
  const bool all =
      std::all_of(kinds.begin(), kinds.end(), [](ScanKind kind) { return kind == ScanKind::surface; });
  return all ? std::vector<ScanKind>{} : kinds;
}

void make_scatter_discs(Cloud& cloud, const Survey& survey, const glm::dvec3& up, float share) {
  std::vector<float> ring(cloud.size());
  std::vector<glm::vec3> around(cloud.size());  // sums of the places around each point
  tbb::parallel_for(std::size_t{0}, cloud.size(), [&](std::size_t i) {
    const auto point = static_cast<std::uint32_t>(i);
    ring[i] = ring_distance(cloud, survey, point);
    for (const std::uint32_t j : survey.around(point)) around[i] += cloud.coord[j] - cloud.coord[i];
  });
  cloud.radius.resize(cloud.size());
  cloud.radius_most.resize(cloud.size(), std::numeric_limits<float>::infinity());
  tbb::parallel_for(std::size_t{0}, cloud.size(), [&](std::size_t i) {
    const auto listed = survey.around(static_cast<std::uint32_t>(i));
    const auto amid = [&](std::uint32_t j) { return !cloud.on_surface(j); };
    if (cloud.on_surface(i) && std::none_of(listed.begin(), listed.end(), amid)) return;
    std::array<float, Survey::LISTED> rings;
    glm::dvec3 inwards(0.0);
    for (std::size_t k = 0; k < listed.size(); ++k) {
      rings[k] = ring[listed[k]];
      inwards += glm::dvec3(around[listed[k]]) +
                 static_cast<double>(Survey::LISTED) * glm::dvec3(cloud.coord[listed[k]] - cloud.coord[i]);
    }
    const float usual = median_of(std::span<float>(rings));
    cloud.radius_most[i] = std::min(cloud.radius_most[i], BESIDE_SCATTER * usual);
    if (cloud.on_surface(i)) return;
    cloud.radius[i] = share * std::min(ring[i], MOST_OVER_USUAL * usual);
    if (!cloud.mean_of.empty() && cloud.kind[i] == ScanKind::scatter && cloud.mean_of[i] > 1)
      show_as_many(cloud, i, static_cast<float>(cloud.mean_of[i]));
    const auto scanner = cloud.sensor_of(i);
    const glm::dvec3 normal =
        unit_or_zero(scanner ? *scanner - glm::dvec3(cloud.coord[i]) : UPWARDS * up - unit_or_zero(inwards));
    cloud.normal[i] = glm::vec3(normal == glm::dvec3(0.0) ? up : normal);
  });
}

}  // namespace splatray
