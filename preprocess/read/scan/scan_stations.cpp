#include "preprocess/read/scan/scan_stations.h"

#include <cmath>
#include <map>

namespace splatray {

bool make_stations(const std::vector<double>& numbers, Points& points) {
  constexpr std::size_t MOST = 65535;
  constexpr double MOST_NUMBER = 4294967295.0;
  std::map<double, std::uint16_t> stations;
  for (const double number : numbers) {
    if (!(std::fabs(number) <= MOST_NUMBER) || number != std::floor(number)) return false;
    stations.emplace(number, std::uint16_t{0});
    if (stations.size() > MOST) return false;
  }
  points.stations.clear();
  for (auto& [number, station] : stations) {
    station = static_cast<std::uint16_t>(points.stations.size());
    points.stations.push_back({std::to_string(static_cast<std::int64_t>(number)), {}, 0, 0});
  }
  points.station.clear();
  points.station.reserve(numbers.size());
  for (const double number : numbers) points.station.push_back(stations.at(number));
  return true;
}

}  // namespace splatray
