#include "preprocess/scan/noise.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <span>

#include "preprocess/base/parallel.h"
#include "preprocess/base/select.h"

namespace splatray {
namespace {

constexpr float ALIKE = 0.9F;               // cosine of normals of one smooth surface
constexpr std::size_t MOST_ASKED = 200000;  // points that give the median well enough

constexpr std::size_t MOST_SORTED = 65536;  // coordinates that show their step

/// What a point and its nearest places disagree about, and what rounding hides of it, in cloud coordinates; 0 where nothing is
/// known.
float disagreement(const Cloud& cloud, const Survey& survey, std::uint32_t i) {
  float sum = 0.0F, count = 0.0F;
  const auto listed = survey.around(i);
  for (const std::uint32_t j : std::span(listed).first(Survey::RING)) {
    if (!cloud.on_surface(j)) continue;
    const float along = glm::dot(cloud.normal[i], cloud.normal[j]);
    if (std::abs(along) < ALIKE) continue;
    const glm::vec3 both = cloud.normal[i] + std::copysign(1.0F, along) * cloud.normal[j];
    const float height = 0.5F * glm::dot(both, cloud.coord[j] - cloud.coord[i]);
    sum += height * height;
    count += 1.0F;
  }
  if (!(count > 0.0F)) return 0.0F;
  const float rounded = glm::dot(survey.step, glm::abs(cloud.normal[i]));
  return std::sqrt(std::max(sum / count, rounded * rounded / 12.0F));
}

/// The median over at most about `most` of the points.
template <typename NoiseOf>
double median(const std::vector<std::uint32_t>& points, std::size_t most, const NoiseOf& noise_of) {
  const std::size_t stride = points.size() / most + 1;
  std::vector<float> noise(points.size() / stride);
  tbb::parallel_for(std::size_t{0}, noise.size(),
                    [&](std::size_t n) { noise[n] = noise_of(points[n * stride]); });
  return noise.empty() ? 0.0 : median_of(std::span(noise));
}

std::vector<std::uint32_t> estimated_points(const Cloud& cloud, const Survey& survey) {
  return numbers_where(cloud.size(),
                       [&](std::size_t i) { return survey.estimated[i] != 0 && cloud.on_surface(i); });
}

/// The numbers among `points` of each station's points.
std::vector<std::vector<std::uint32_t>> by_station(const Cloud& cloud, std::vector<std::uint32_t> points) {
  std::vector<std::vector<std::uint32_t>> lists(std::max<std::size_t>(cloud.stations.size(), 1));
  if (cloud.station.empty()) return lists[0] = std::move(points), lists;
  for (const std::uint32_t i : points) lists[cloud.station[i]].push_back(i);
  return lists;
}

/// Along each axis, world units, of these points.
glm::dvec3 step_world(const Cloud& cloud, const std::vector<std::uint32_t>& points) {
  const std::size_t stride = points.size() / MOST_SORTED + 1;
  glm::dvec3 step(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> places;
    for (std::size_t n = 0; n < points.size(); n += stride) places.push_back(cloud.position[points[n]][axis]);
    std::sort(places.begin(), places.end());
    double least = 0.0;
    for (std::size_t i = 1; i < places.size(); ++i) {
      const double apart = places[i] - places[i - 1];
      if (apart > 0.0 && (least == 0.0 || apart < least)) least = apart;
    }
    step[axis] = least;
  }
  return step;
}

}  // namespace

glm::vec3 coordinate_step(const Cloud& cloud) {
  const auto all = numbers_where(cloud.size(), [](std::size_t) { return true; });
  return glm::vec3(step_world(cloud, all) / cloud.half_extent_world);
}

std::vector<double> station_step_world(const Cloud& cloud) {
  std::vector<double> steps;
  const auto all = numbers_where(cloud.size(), [](std::size_t) { return true; });
  for (const auto& points : by_station(cloud, all)) {
    const glm::dvec3 step = step_world(cloud, points);
    steps.push_back(std::max({step.x, step.y, step.z}));
  }
  return steps;
}

double measure_noise(const Cloud& cloud, const Survey& survey) {
  return median(estimated_points(cloud, survey), MOST_ASKED, [&](auto i) {
    return survey.reach[i] > 0.0F ? disagreement(cloud, survey, i) / survey.reach[i] : 0.0F;
  });
}

std::vector<double> station_noise_world(const Cloud& cloud, const Survey& survey) {
  std::vector<double> noise;
  for (const auto& points : by_station(cloud, estimated_points(cloud, survey)))
    noise.push_back(cloud.half_extent_world / std::numbers::sqrt2 *
                    median(points, MOST_ASKED, [&](auto i) { return disagreement(cloud, survey, i); }));
  return noise;
}

}  // namespace splatray
