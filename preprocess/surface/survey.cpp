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
constexpr double LINE = 0.02;  // second variance / first: below this the places of a neighbourhood lie on a line

double entropy(const glm::dvec3& variance) {
  const double sum = variance.x + variance.y + variance.z;
  double entropy = 0.0;
  for (int i = 0; i < 3; ++i)
    if (variance[i] > 0.0) entropy -= variance[i] / sum * std::log(variance[i] / sum);
  return entropy;
}

/// The normal of a neighbourhood, and its roughness.
struct Plane {
  glm::dvec3 axis{0.0};
  double roughness = 0.0;
};

Plane best_plane(std::span<const glm::dvec3> offsets) {
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
  const LeastAxis found = best.least_axis();
  const double sum = found.variance.x + found.variance.y + found.variance.z;
  return {found.axis, sum > 0.0 ? found.variance.x / sum : 0.0};
}

}  // namespace

Survey survey_points(Cloud& cloud, const glm::dvec3& up, const Stage& stage) {
  Survey survey;
  survey.listed.resize(cloud.size() * Survey::LISTED);
  survey.reach.resize(cloud.size());
  survey.roughness.resize(cloud.size());
  const NeighbourSearch search(cloud, Sites::positions);
  search.find_all(SIZES.back(), stage, [&](std::uint32_t i, std::span<const Neighbour> nearest) {
    for (std::size_t j = 0; j < Survey::LISTED; ++j)
      survey.listed[i * Survey::LISTED + j] = j < nearest.size() ? nearest[j].index() : i;
    if (nearest.empty()) {
      if (cloud.normal[i] == glm::vec3(0.0F)) cloud.normal[i] = glm::vec3(up);
      return;
    }
    survey.reach[i] = std::sqrt(nearest[std::min(nearest.size(), Survey::RING) - 1].distance_squared());
    std::array<glm::dvec3, SIZES.back()> offsets;
    for (std::size_t j = 0; j < nearest.size(); ++j)
      offsets[j] = glm::dvec3(cloud.coord[nearest[j].index()] - cloud.coord[i]);
    const std::span<const glm::dvec3> found = std::span(offsets).first(nearest.size());
    const Plane plane = best_plane(found);
    survey.roughness[i] = static_cast<float>(plane.roughness);
    if (cloud.normal[i] != glm::vec3(0.0F)) return;
    cloud.normal[i] = glm::vec3(plane.axis != glm::dvec3(0.0) ? plane.axis : plane_normal(found, up));
  });
  return survey;
}

}  // namespace splatray
