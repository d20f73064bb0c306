#include "preprocess/scan/survey.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <utility>
#include <vector>

#include "engine/base/release.h"
#include "preprocess/scan/noise.h"
#include "preprocess/scan/plane_fit.h"
#include "preprocess/surface/neighbours.h"
#include "preprocess/surface/normals.h"

namespace splatray {
namespace {

constexpr std::array<std::size_t, 3> SIZES{8, 16, 32};
constexpr double LINE =
    0.02;  // second variance / first: below this the places of a neighbourhood lie on a line

constexpr std::array<std::size_t, 2> WIDER_STRIDES{8, 64};
constexpr float ROUGH = 0.03F;  // of a neighbourhood that noise or edges describe better than a plane does
constexpr double ROUGHEST =
    1.0 / 3.0;                // of a line too: one ring with its noise makes a plane across the surface
constexpr float EVEN = 2.0F;  // distance to the 32nd place over that to the 8th on a surface
constexpr float ROOM = 1.3F;  // squared distance that is searched over what is expected
constexpr float ROUGH_TOGETHER =
    0.3F;                          // extent of rough points that share a wider neighbourhood, over its radius
constexpr double FLATTER = 0.5;    // roughness of a wider one that is better, over that
constexpr double DRAWN_OUT = 0.3;  // second deviation / first: below this a neighbourhood shows no surface
constexpr std::size_t KIND_STRIDE =
    WIDER_STRIDES[0];                       // of the wider neighbourhoods that show what points are part of
constexpr std::size_t HALF_OF_PLACES = 16;  // of their places, that are looked at beside all
constexpr float THICK = 1.0F;               // flatness of what is neither line nor surface
constexpr double THICKER =
    1.4;  // deviation across a wider one that is still the noise of a surface, over that of 32

float entropy(const glm::dvec3& variance) {
  const double by = 1.0 / (variance.x + variance.y + variance.z);
  float entropy = 0.0F;
  for (int i = 0; i < 3; ++i) {
    const auto share = static_cast<float>(variance[i] * by);
    if (share > 0.0F) entropy -= share * std::log(share);
  }
  return entropy;
}

/// The plane of a neighbourhood.
struct SurveyPlane {
  glm::dvec3 axis{0.0};  ///< zero where it has none
  double roughness = ROUGHEST;
  float flatness = 0.0F;   ///< Survey::flatness of all its sizes
  double thickness = 0.0;  ///< deviation across the whole
};

bool is_line(const glm::dvec3& variance) { return variance.y < LINE * variance.z; }

/// What planes are chosen by, the least first.
float order_of(const glm::dvec3& variance) {
  return is_line(variance) ? std::numeric_limits<float>::max() : entropy(variance);
}

double roughness_of(const glm::dvec3& variance) {
  const double sum = variance.x + variance.y + variance.z;
  return is_line(variance) || !(sum > 0.0) ? ROUGHEST : variance.x / sum;
}

/// Survey::flatness of one neighbourhood.
float flatness_of(const glm::dvec3& variance) {
  const bool spreads = variance.y >= DRAWN_OUT * DRAWN_OUT * variance.z && variance.y > 0.0;
  return spreads ? static_cast<float>(std::sqrt(variance.x / variance.y))
                 : std::numeric_limits<float>::infinity();
}

Offsets offsets_of(const Cloud& cloud, const glm::vec3& place, std::span<const Neighbour> nearest) {
  Offsets offsets;
  for (const Neighbour& neighbour : nearest) offsets.add(cloud.coord[neighbour.index()] - place);
  return offsets;
}

/// The plane of the `whole` neighbourhood where that is flat, else of the part with the least entropy; the roughness is the
/// whole's.
SurveyPlane best_plane(const Offsets& offsets, const Covariance& whole, const glm::dvec3& its_variances) {
  Covariance best = whole;
  glm::dvec3 variances = its_variances;
  SurveyPlane plane{{}, roughness_of(variances), flatness_of(variances), std::sqrt(variances.x)};
  if (plane.flatness == std::numeric_limits<float>::infinity())
    plane.thickness = plane.flatness;  // one line of a scanner does not show what is across
  if (plane.roughness > ROUGH || plane.flatness > Survey::FLAT) {
    float least = order_of(variances);
    for (const std::size_t size : {SIZES[1], SIZES[0]}) {
      if (size >= offsets.count) continue;
      const Covariance covariance = covariance_of(offsets, size);
      const glm::dvec3 its = variances_of(covariance);
      plane.flatness = std::min(plane.flatness, flatness_of(its));
      const float here = order_of(its);
      if (!(plane.roughness > ROUGH && here < least)) continue;
      least = here;
      best = covariance, variances = its;
    }
  }
  plane.axis = least_axis_of(best, variances);
  return plane;
}

/// The normal of a neighbourhood without a plane of its own.
glm::dvec3 degenerate_plane(const Cloud& cloud, std::uint32_t i, std::span<const Neighbour> nearest,
                            const glm::dvec3& up) {
  std::vector<glm::dvec3> places;
  for (const Neighbour& neighbour : nearest)
    places.emplace_back(cloud.coord[neighbour.index()] - cloud.coord[i]);
  return plane_normal(places, up);
}

/// Every `stride`-th point: places only.
Cloud thinned(const Cloud& cloud, std::size_t stride) {
  Cloud thin;
  thin.coord.resize((cloud.size() + stride - 1) / stride);
  for (std::size_t i = 0; i < thin.coord.size(); ++i) thin.coord[i] = cloud.coord[i * stride];
  return thin;
}

/// Rough points next to each other that share a wider neighbourhood.
struct Bunch {
  std::uint32_t begin, end;  ///< among the rough points
  glm::vec3 middle;
  float expected_squared;  ///< the least Survey::expected_squared of them
};

/// In a deque, as an array that grows takes the room of three times as many.
std::deque<Bunch> find_bunches(const Cloud& cloud, const Survey& survey,
                               const std::vector<std::uint32_t>& rough, float count) {
  std::deque<Bunch> bunches;
  for (std::uint32_t begin = 0; begin < rough.size();) {
    float expected_squared = survey.expected_squared(rough[begin], count);
    glm::vec3 low = cloud.coord[rough[begin]], high = low;
    std::uint32_t end = begin + 1;
    for (; end < rough.size(); ++end) {
      const glm::vec3& place = cloud.coord[rough[end]];
      const glm::vec3 new_low = glm::min(low, place), new_high = glm::max(high, place);
      const glm::vec3 across = new_high - new_low;
      const float least = std::min(expected_squared, survey.expected_squared(rough[end], count));
      if (glm::dot(across, across) > ROUGH_TOGETHER * ROUGH_TOGETHER * least) break;
      low = new_low, high = new_high, expected_squared = least;
    }
    bunches.push_back({begin, end, 0.5F * (low + high), expected_squared});
    begin = end;
  }
  return bunches;
}

/// What wider surroundings may be better than.
struct Rough {
  std::vector<float> roughness, thickness;  ///< of each point's plane
};

/// The variances of wider neighbourhoods that show what points are part of: of HALF_OF_PLACES the places, and of all.
using WideVariances = std::array<glm::dvec3, 2>;

/// Survey::flatness with those of wider neighbourhoods that are hardly thicker than `thickness`; of a line only where the first
/// of them is none.
float wide_flatness(float flatness, const WideVariances& variances, float thickness) {
  const bool along = flatness_of(variances[0]) == std::numeric_limits<float>::infinity();
  if (along && thickness == std::numeric_limits<float>::infinity())
    return std::numeric_limits<float>::infinity();
  flatness = std::min(flatness, THICK);
  for (const glm::dvec3& variance : variances)
    if (variance.x <= THICKER * THICKER * thickness * thickness)
      flatness = std::min(flatness, flatness_of(variance));
  return flatness;
}

/// Tries rough points among every `stride`-th point.
void look_wider(Cloud& cloud, std::size_t stride, Survey& survey, Rough& of, const Stage& stage) {
  const bool kinds = stride == KIND_STRIDE;
  const auto rough = numbers_where(cloud.size(), [&](std::size_t i) {
    return of.roughness[i] > ROUGH || (kinds && survey.flatness[i] > Survey::FLAT);
  });
  if (rough.empty() || cloud.size() < stride * SIZES.back()) return;
  const Cloud thin = thinned(cloud, stride);
  const NeighbourSearch search(thin, Sites::positions);
  const auto bunches = find_bunches(cloud, survey, rough, static_cast<float>(stride * SIZES.back()));
  const auto query = [&](std::uint32_t n) -> NeighbourSearch::Query {
    return {bunches[n].middle, ROOM * bunches[n].expected_squared, std::numeric_limits<float>::infinity()};
  };
  const auto try_plane = [&](std::uint32_t n, std::span<const Neighbour> nearest) {
    const Offsets offsets = offsets_of(thin, bunches[n].middle, nearest);
    const Covariance whole = covariance_of(offsets, offsets.count);
    WideVariances variances{glm::dvec3(0.0), variances_of(whole)};
    const SurveyPlane plane = best_plane(offsets, whole, variances[1]);
    if (kinds) variances[0] = variances_of(covariance_of(offsets, std::min(HALF_OF_PLACES, offsets.count)));
    for (std::uint32_t r = bunches[n].begin; r < bunches[n].end; ++r) {
      const std::uint32_t i = rough[r];
      if (kinds) survey.flatness[i] = wide_flatness(survey.flatness[i], variances, of.thickness[i]);
      if (!(plane.roughness < FLATTER * of.roughness[i]) || plane.axis == glm::dvec3(0.0)) continue;
      cloud.normal[i] = glm::vec3(plane.axis);
      of.roughness[i] = static_cast<float>(plane.roughness);
    }
  };
  search.find_each(bunches.size(), query, SIZES.back(), stage, try_plane);
}

/// What is known of each point before wider surroundings are tried.
void look_around(Cloud& cloud, const glm::dvec3& up, bool all_given, Survey& survey, Rough& rough,
                 const Stage& stage) {
  survey.near = std::make_unique<NearPlaces>(cloud);
  const auto visit = [&](std::uint32_t i, std::span<const Neighbour> nearest) {
    survey.near->list(i, nearest);
    survey.estimated[i] = cloud.normal[i] == glm::vec3(0.0F);
    if (nearest.empty()) {
      if (survey.estimated[i] != 0) cloud.normal[i] = glm::vec3(up);
      return;
    }
    survey.reach[i] = std::sqrt(nearest[std::min(nearest.size(), Survey::RING) - 1].distance_squared());
    survey.wide[i] = nearest.size() == Survey::WIDE ? std::sqrt(nearest.back().distance_squared())
                                                    : EVEN * survey.reach[i];
    if (survey.estimated[i] == 0) return;
    const Offsets offsets = offsets_of(cloud, cloud.coord[i], nearest);
    const Covariance whole = covariance_of(offsets, offsets.count);
    const SurveyPlane plane = best_plane(offsets, whole, variances_of(whole));
    rough.roughness[i] = static_cast<float>(plane.roughness);
    rough.thickness[i] = static_cast<float>(plane.thickness);
    survey.flatness[i] = plane.flatness;
    cloud.normal[i] =
        glm::vec3(plane.axis != glm::dvec3(0.0) ? plane.axis : degenerate_plane(cloud, i, nearest, up));
  };
  survey.near->search().find_all(all_given ? Survey::LISTED : Survey::WIDE, stage, visit);
}

}  // namespace

float Survey::growth(std::size_t point) const {
  if (!(reach[point] > 0.0F)) return 1.0F;
  return std::min(wide[point] * wide[point] / (reach[point] * reach[point]), EVEN * EVEN);
}

float Survey::expected_squared(std::size_t point, float count) const {
  const float squared = wide[point] * wide[point];
  return squared * std::pow(growth(point), 0.5F * std::log2(count / static_cast<float>(WIDE)));
}

float Survey::expected_count(std::size_t point, float squared) const {
  constexpr float SPACE = 2.5F;  // growth where places fill space: few are in no more dimensions
  const float ratio = squared / (wide[point] * wide[point]);
  return ratio > 0.0F && std::isfinite(ratio)
             ? static_cast<float>(WIDE) *
                   std::exp2(2.0F * std::log2(ratio) / std::log2(std::max(growth(point), SPACE)))
             : static_cast<float>(WIDE);
}

void Survey::keep(const Cloud& cloud, const std::vector<std::uint32_t>& kept,
                  const std::vector<std::uint32_t>& number) {
  reach = gather(reach, kept);
  wide = gather(wide, kept);
  estimated = gather(estimated, kept);
  if (!sided.empty()) sided = gather(sided, kept);
  flatness = gather(flatness, kept);
  near->keep(cloud, kept, number);
}

Survey survey_points(Cloud& cloud, const glm::dvec3& up, const Stage& stage) {
  const bool all_given = std::none_of(cloud.normal.begin(), cloud.normal.end(),
                                      [](const glm::vec3& normal) { return normal == glm::vec3(0.0F); });
  Survey survey;
  if (!all_given) survey.step = coordinate_step(cloud), release(cloud.position);
  survey.reach.resize(cloud.size());
  survey.wide.resize(cloud.size());
  survey.estimated.resize(cloud.size());
  Rough rough;
  if (!all_given) {
    survey.flatness.resize(cloud.size());
    rough.roughness.resize(cloud.size()), rough.thickness.resize(cloud.size());
  }
  look_around(cloud, up, all_given, survey, rough, stage);
  if (all_given) return survey;
  for (const std::size_t stride : WIDER_STRIDES) look_wider(cloud, stride, survey, rough, stage);
  return survey;
}

}  // namespace splatray
