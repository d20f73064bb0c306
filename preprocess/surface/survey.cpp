#include "preprocess/surface/survey.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "preprocess/surface/neighbours.h"
#include "preprocess/surface/normals.h"
#include "preprocess/surface/plane_fit.h"

namespace splatray {
namespace {

constexpr std::array<std::size_t, 3> SIZES{8, 16, 32};
constexpr double LINE =
    0.02;  // second variance / first: below this the places of a neighbourhood lie on a line

double entropy(const glm::dvec3& variance) {
  const double sum = variance.x + variance.y + variance.z;
  double entropy = 0.0;
  for (int i = 0; i < 3; ++i)
    if (variance[i] > 0.0) entropy -= variance[i] / sum * std::log(variance[i] / sum);
  return entropy;
}

/// The normal of the best of the neighbourhoods; zero where it has none.
glm::dvec3 best_axis(std::span<const glm::dvec3> offsets) {
  PlaneFit fit, best;
  fit.add(glm::dvec3(0.0));
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < offsets.size(); ++j) {
    fit.add(offsets[j]);
    const bool last = j + 1 == offsets.size();
    if (!last && std::find(SIZES.begin(), SIZES.end(), j + 1) == SIZES.end()) continue;
    const glm::dvec3 variance = fit.variances();
    const bool line = variance.y < LINE * variance.z;
    const double here = line ? std::numeric_limits<double>::max() : entropy(variance);
    if (!(here < least) && !(line && here == least)) continue;
    least = here;
    best = fit;
  }
  return best.least_axis().axis;
}

}  // namespace

Survey Survey::kept(const std::vector<std::uint32_t>& kept, const std::vector<std::uint32_t>& number) const {
  Survey survey;
  survey.reach = gather(reach, kept);
  survey.estimated = gather(estimated, kept);
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
  const NeighbourSearch search(cloud, Sites::positions);
  const bool all_given = std::none_of(cloud.normal.begin(), cloud.normal.end(),
                                      [](const glm::vec3& normal) { return normal == glm::vec3(0.0F); });
  search.find_all(all_given ? Survey::LISTED : SIZES.back(), stage,
                  [&](std::uint32_t i, std::span<const Neighbour> nearest) {
                    for (std::size_t j = 0; j < Survey::LISTED; ++j)
                      survey.listed[i * Survey::LISTED + j] = j < nearest.size() ? nearest[j].index() : i;
                    survey.estimated[i] = cloud.normal[i] == glm::vec3(0.0F);
                    if (nearest.empty()) {
                      if (survey.estimated[i] != 0) cloud.normal[i] = glm::vec3(up);
                      return;
                    }
                    survey.reach[i] =
                        std::sqrt(nearest[std::min(nearest.size(), Survey::RING) - 1].distance_squared());
                    if (survey.estimated[i] == 0) return;
                    std::array<glm::dvec3, SIZES.back()> offsets;
                    for (std::size_t j = 0; j < nearest.size(); ++j)
                      offsets[j] = glm::dvec3(cloud.coord[nearest[j].index()] - cloud.coord[i]);
                    const std::span<const glm::dvec3> found = std::span(offsets).first(nearest.size());
                    const glm::dvec3 axis = best_axis(found);
                    cloud.normal[i] = glm::vec3(axis != glm::dvec3(0.0) ? axis : plane_normal(found, up));
                  });
  return survey;
}

}  // namespace splatray
