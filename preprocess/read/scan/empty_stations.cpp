#include "preprocess/read/scan/empty_stations.h"

#include <cstdint>
#include <utility>

namespace splatray {

std::vector<std::string> remove_empty_stations(Points& points) {
  std::vector<std::string> removed;
  std::vector<bool> has_points(points.stations.size(), false);
  for (const std::uint16_t station : points.station) has_points[station] = true;
  if (points.station.empty() && !has_points.empty()) has_points[0] = true;
  std::vector<Station> kept;
  std::vector<std::uint16_t> number(has_points.size(), 0);
  for (std::size_t s = 0; s < has_points.size(); ++s) {
    Station& station = points.stations[s];
    number[s] = static_cast<std::uint16_t>(kept.size());
    if (has_points[s])
      kept.push_back(std::move(station));
    else
      removed.push_back(station.name.empty() ? "number " + std::to_string(s + 1) : station.name);
  }
  points.stations = std::move(kept);
  if (!removed.empty())
    for (std::uint16_t& station : points.station) station = number[station];
  return removed;
}

}  // namespace splatray
