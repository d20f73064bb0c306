#include "preprocess/surface/strays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "preprocess/base/select.h"

namespace splatray {
namespace {

constexpr double FAR = 4.0;                                           // of a stray's neighbours, in units of what is expected
const double GRAZING = std::sin(4.0 * std::numbers::pi / 180.0);  // of a plane that a beam cannot have met

double median_of(std::vector<float> values) {
  if (values.empty()) return 0.0;
  select_nth(std::span(values), values.size() / 2, std::identity());
  return values[values.size() / 2];
}

}  // namespace

std::vector<Stray> find_strays(const Cloud& cloud, const Survey& survey) {
  std::vector<Stray> strays(cloud.size(), Stray::no);
  std::vector<std::vector<float>> steps(cloud.stations.size());
  const auto station_of = [&](std::size_t i) { return cloud.station.empty() ? 0U : cloud.station[i]; };
  std::vector<glm::vec3> sensors(cloud.stations.size());
  for (std::size_t s = 0; s < sensors.size(); ++s)
    if (cloud.stations[s].sensor_world)
      sensors[s] = glm::vec3((*cloud.stations[s].sensor_world - cloud.center_world) / cloud.half_extent_world);
  for (std::size_t i = 0; i < cloud.size() && !sensors.empty(); ++i) {
    const std::uint32_t s = station_of(i);
    if (cloud.stations[s].sensor_world) steps[s].push_back(survey.reach[i] / glm::length(cloud.coord[i] - sensors[s]));
  }
  std::vector<double> step;
  for (auto& list : steps) step.push_back(median_of(list)/ std::numbers::sqrt2);
  tbb::parallel_for(std::size_t{0}, cloud.size(), [&](std::size_t i) {
    std::array<float, Survey::LISTED> around;
    for (std::size_t j = 0; j < around.size(); ++j) around[j] = survey.reach[survey.around(i)[j]];
    std::nth_element(around.begin(), around.begin() + 6, around.end());
    if (survey.reach[i] > FAR * around[6]) strays[i] = Stray::isolated;
    if (sensors.empty()) return;
    const std::uint32_t s = station_of(i);
    if (!cloud.stations[s].sensor_world) return;
    const glm::vec3 to_point = cloud.coord[i] - sensors[s];
    const double range = glm::length(to_point);
    if (survey.reach[i] > FAR * step[s] * range) strays[i] = Stray::isolated;
    else if (std::abs(glm::dot(cloud.normal[i], to_point)) < GRAZING * range) strays[i] = Stray::mixed;
  });
  return strays;
}

}  // namespace splatray
