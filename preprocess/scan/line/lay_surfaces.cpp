#include <algorithm>
#include <utility>

#include "engine/base/release.h"
#include "preprocess/scan/line/lines.h"

namespace splatray {
namespace {

/// The scanner's place, where only its rings show it, as a station.
void find_station(Cloud& cloud, const std::vector<LinePlace>& lines) {
  if (lines.empty() || std::any_of(cloud.stations.begin(), cloud.stations.end(),
                                   [](const Station& station) { return station.sensor_world.has_value(); }))
    return;
  const std::optional<glm::dvec3> sensor = find_spinning_sensor(cloud, lines);
  if (!sensor) return;
  cloud.stations = {Station{"", cloud.center_world + cloud.half_extent_world * *sensor}};
  release(cloud.station);
  release(cloud.grid_cell);
}

}  // namespace

void lay_line_surfaces(Cloud& cloud, const Survey& survey, bool splats, const Stage& stage) {
  std::vector<LinePlace> lines = find_lines(cloud, survey, stage);
  if (lines.empty()) return;
  find_station(cloud, lines);
  std::vector<std::pair<Sweep, std::vector<std::uint32_t>>> sweeps;
  for (std::size_t s = 0; s < cloud.stations.size(); ++s) {
    if (!cloud.stations[s].sensor_world) continue;
    auto points = numbers_where(cloud.size(), [&](std::size_t i) { return cloud.station_of(i) == s; });
    const glm::dvec3 sensor =
        (*cloud.stations[s].sensor_world - cloud.center_world) / cloud.half_extent_world;
    if (const auto sweep = find_rings(cloud, points, sensor, lines))
      sweeps.emplace_back(*sweep, std::move(points));
  }
  join_lines(cloud, survey, splats, lines);
  for (const auto& [sweep, points] : sweeps) settle_rest(cloud, survey, points, sweep, splats, lines);
}

}  // namespace splatray
