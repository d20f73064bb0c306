#include "preprocess/scan/survey.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "preprocess/scan/plane_fit.h"
#include "preprocess/surface/neighbours.h"
#include "preprocess/surface/normals.h"

namespace splatray {
namespace {

constexpr std::array<std::size_t, 3> SIZES{8, 16, 32};
constexpr double LINE =
    0.02;  // second variance / first: below this the places of a neighbourhood lie on a line

constexpr std::array<std::size_t, 2> STRIDES{8, 64};
constexpr float ROUGH = 0.03F;  // of a neighbourhood that noise or edges tell more of than a plane does
constexpr double ROUGHEST =
    1.0 / 3.0;  // of a line too: one ring with its noise makes a plane across the surface
constexpr float GUESS =
    1.3F * 32 / 8;               // squared distance to the 32nd of thinned points over stride and reach^2
constexpr double FLATTER = 0.5;  // roughness of a wider one that is better, over that

double entropy(const glm::dvec3& variance) {
  const double sum = variance.x + variance.y + variance.z;
  double entropy = 0.0;
  for (int i = 0; i < 3; ++i)
    if (variance[i] > 0.0) entropy -= variance[i] / sum * std::log(variance[i] / sum);
  return entropy;
}

/// The plane of a neighbourhood.
struct Plane {
  glm::dvec3 axis{0.0};  ///< zero where it has none
  double roughness = ROUGHEST;
};

double roughness_of(const glm::dvec3& variance) {
  const double sum = variance.x + variance.y + variance.z;
  return variance.y < LINE * variance.z || !(sum > 0.0) ? ROUGHEST : variance.x / sum;
}

/// The plane of the whole neighbourhood where that is flat, else of the part with the least entropy; the roughness is the
/// whole's.
Plane best_plane(std::span<const glm::dvec3> offsets) {
  PlaneFit fit, best;
  fit.add(glm::dvec3(0.0));
  double roughness = ROUGHEST, least = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < offsets.size(); ++j) {
    fit.add(offsets[j]);
    const bool whole = j + 1 == offsets.size();
    if (!whole && std::find(SIZES.begin(), SIZES.end(), j + 1) == SIZES.end()) continue;
    const glm::dvec3 variance = fit.variances();
    roughness = roughness_of(variance);
    const bool line = variance.y < LINE * variance.z;
    const double here = line ? std::numeric_limits<double>::max() : entropy(variance);
    if (!(here <= least) && !(whole && roughness <= ROUGH)) continue;
    least = here;
    best = fit;
  }
  return {best.least_axis().axis, roughness};
}

/// Every `stride`-th point: places only.
Cloud thinned(const Cloud& cloud, std::size_t stride) {
  Cloud thin;
  thin.coord.resize((cloud.size() + stride - 1) / stride);
  for (std::size_t i = 0; i < thin.coord.size(); ++i) thin.coord[i] = cloud.coord[i * stride];
  thin.position.resize(thin.coord.size());
  thin.normal.resize(thin.coord.size());
  return thin;
}

/// Tries rough points among every `stride`-th point.
void look_wider(Cloud& cloud, std::size_t stride, Survey& survey, const Stage& stage) {
  const auto rough = numbers_where(cloud.size(), [&](std::size_t i) { return survey.roughness[i] > ROUGH; });
  if (rough.empty() || cloud.size() < stride * SIZES.back()) return;
  const Cloud thin = thinned(cloud, stride);
  const NeighbourSearch search(thin, Sites::positions);
  parallel_each(stage, rough.size(), [&](std::size_t n) {
    const std::uint32_t i = rough[n];
    std::array<Neighbour, SIZES.back()> nearest;
    std::array<glm::dvec3, SIZES.back()> offsets;
    const float guess = GUESS * static_cast<float>(stride) * survey.reach[i] * survey.reach[i];
    const std::size_t found = search.find(cloud.coord[i], nearest, guess);
    for (std::size_t j = 0; j < found; ++j)
      offsets[j] = glm::dvec3(thin.coord[nearest[j].index()] - cloud.coord[i]);
    const Plane plane = best_plane(std::span(offsets).first(found));
    if (plane.axis == glm::dvec3(0.0) || !(plane.roughness < FLATTER * survey.roughness[i])) return;
    cloud.normal[i] = glm::vec3(plane.axis);
    survey.roughness[i] = static_cast<float>(plane.roughness);
  });
}

}  // namespace

Survey Survey::kept(const std::vector<std::uint32_t>& kept, const std::vector<std::uint32_t>& number) const {
  Survey survey;
  survey.reach = gather(reach, kept);
  survey.estimated = gather(estimated, kept);
  survey.roughness = gather(roughness, kept);
  survey.listed.resize(kept.size() * LISTED);
  tbb::parallel_for(std::size_t{0}, kept.size(), [&](std::size_t n) {
    for (std::size_t j = 0; j < LISTED; ++j) {
      const std::uint32_t other = number[around(kept[n])[j]];
      survey.listed[n * LISTED + j] = other == NO_CELL ? static_cast<std::uint32_t>(n) : other;
    }
  });
  return survey;
}

Survey survey_points(Cloud& cloud, const glm::dvec3& up, const Stage& stage) {
  Survey survey;
  survey.listed.resize(cloud.size() * Survey::LISTED);
  survey.reach.resize(cloud.size());
  survey.estimated.resize(cloud.size());
  survey.roughness.resize(cloud.size());
  const NeighbourSearch search(cloud, Sites::positions);
  const bool all_given = std::none_of(cloud.normal.begin(), cloud.normal.end(),
                                      [](const glm::vec3& normal) { return normal == glm::vec3(0.0F); });
  search.find_all(
      all_given ? Survey::LISTED : SIZES.back(), stage,
      [&](std::uint32_t i, std::span<const Neighbour> nearest) {
        for (std::size_t j = 0; j < Survey::LISTED; ++j)
          survey.listed[i * Survey::LISTED + j] = j < nearest.size() ? nearest[j].index() : i;
        survey.estimated[i] = cloud.normal[i] == glm::vec3(0.0F);
        if (nearest.empty()) {
          if (survey.estimated[i] != 0) cloud.normal[i] = glm::vec3(up);
          return;
        }
        survey.reach[i] = std::sqrt(nearest[std::min(nearest.size(), Survey::RING) - 1].distance_squared());
        if (survey.estimated[i] == 0) return;
        std::array<glm::dvec3, SIZES.back()> offsets;
        for (std::size_t j = 0; j < nearest.size(); ++j)
          offsets[j] = glm::dvec3(cloud.coord[nearest[j].index()] - cloud.coord[i]);
        const std::span<const glm::dvec3> found = std::span(offsets).first(nearest.size());
        const Plane plane = best_plane(found);
        survey.roughness[i] = static_cast<float>(plane.roughness);
        cloud.normal[i] = glm::vec3(plane.axis != glm::dvec3(0.0) ? plane.axis : plane_normal(found, up));
      });
  for (const std::size_t stride : STRIDES) look_wider(cloud, stride, survey, stage);
  return survey;
}

}  // namespace splatray
