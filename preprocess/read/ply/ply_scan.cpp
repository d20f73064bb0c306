#include "preprocess/read/ply/ply_scan.h"

#include <cmath>
#include <iterator>
#include <sstream>
#include <utility>

#include "engine/base/number_text.h"
#include "preprocess/read/scan/sensor_place.h"

namespace splatray {
namespace {

/// The whole number of the remark "<key> <number>", 0 = none.
std::uint64_t remarked(const PlyHeader& header, const std::string& key) {
  for (const std::string& remark : header.remarks) {
    std::istringstream words(remark);
    std::string first;
    std::uint64_t number = 0;
    if (words >> first >> number && first == key) return number;
  }
  return 0;
}

struct Sensor {
  std::string number;  ///< "" = none is given
  glm::dvec3 place{0.0};
};

std::vector<Sensor> remarked_sensors(const PlyHeader& header) {
  std::vector<Sensor> sensors;
  for (const std::string& remark : header.remarks) {
    std::istringstream stream(remark);
    std::vector<std::string> words{std::istream_iterator<std::string>(stream), {}};
    if (words.size() < 4 || words.size() > 5 || words[0] != "sensor") continue;
    const auto place =
        split_numbers(words[words.size() - 3] + ' ' + words[words.size() - 2] + ' ' + words.back(), ' ', 3);
    if (place.empty()) continue;
    sensors.push_back({words.size() == 5 ? words[1] : "", {place[0], place[1], place[2]}});
  }
  return sensors;
}

}  // namespace

std::optional<glm::uvec2> range_grid_form(const PlyHeader& header, const PlyElement& element) {
  const std::uint64_t rows = remarked(header, "num_rows");
  const std::uint64_t columns = remarked(header, "num_cols");
  const bool whole = rows > 0 && columns > 0 && element.count < NO_CELL && element.count / rows == columns &&
                     element.count % rows == 0;
  return whole ? std::optional(glm::uvec2(rows, columns)) : std::nullopt;
}

std::uint64_t read_range_grid(PlyBody& in, const PlyElement& element, std::size_t list,
                              const glm::uvec2& rows_columns, Points& points) {
  points.grid_cell.assign(points.size(), NO_CELL);
  std::uint32_t cell = 0;
  const std::uint64_t rows = in.read_rows(element, [&] {
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      if (i != list) {
        in.skip(property);
        continue;
      }
      for (std::uint64_t left = in.list_length(property); left > 0; --left) {
        const double vertex = in.number(property.type);
        if (!(vertex >= 0.0 && vertex < static_cast<double>(points.size())))
          in.fail("a cell of the range grid has vertex " + std::to_string(vertex) + ", expected less than " +
                  std::to_string(points.size()));
        points.grid_cell[static_cast<std::size_t>(vertex)] = cell;
      }
    }
    ++cell;
  });
  if (rows < element.count) return points.grid_cell.clear(), rows;
  points.stations.resize(1);
  points.station.clear();
  points.stations[0].rows = rows_columns.x;
  points.stations[0].columns = rows_columns.y;
  return rows;
}

void place_sensors(const PlyHeader& header, Points& points) {
  const std::vector<Sensor> sensors = remarked_sensors(header);
  if (sensors.empty()) return;
  if (points.stations.empty()) points.stations.resize(1);
  for (const Sensor& sensor : sensors)
    for (Station& station : points.stations)
      if ((sensors.size() == 1 && points.stations.size() == 1) || station.name == sensor.number)
        station.sensor_world = credible_sensor(sensor.place, points.position);
}

}  // namespace splatray
