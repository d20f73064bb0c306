#include <algorithm>
#include <utility>

#include "preprocess/scan/line/lines.h"

namespace splatray {

void lay_line_surfaces(Cloud& cloud, const Survey& survey, bool splats, std::vector<LinePlace> lines) {
  if (lines.empty()) return;
  std::vector<std::pair<Sweep, std::vector<std::uint32_t>>> sweeps;
  for (std::size_t s = 0; s < cloud.stations.size(); ++s) {
    if (!cloud.stations[s].sensor_world) continue;
    auto points = numbers_where(cloud.size(), [&](std::size_t i) { return cloud.station_of(i) == s; });
    const glm::dvec3 sensor = cloud.in_cloud(*cloud.stations[s].sensor_world);
    if (const auto sweep = find_rings(cloud, points, sensor, lines))
      sweeps.emplace_back(*sweep, std::move(points));
  }
  join_lines(cloud, survey, splats, lines);
  for (const auto& [sweep, points] : sweeps) settle_rest(cloud, survey, points, sweep, splats, lines);
}

}  // namespace splatray
