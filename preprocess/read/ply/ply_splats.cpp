#include "preprocess/read/ply/ply_splats.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "engine/base/number_text.h"

namespace splatray {
namespace {

constexpr std::string_view LATTICE = "splatray lattice ", UP = "splatray up ", SCAN = "splatray scan ",
                           CRS = "crs ";
constexpr std::size_t MOST_STATIONS = 65535;

/// What follows `key`, of each remark that begins so.
std::vector<std::string> remarks_of(const PlyHeader& header, std::string_view key) {
  std::vector<std::string> texts;
  for (const std::string& remark : header.remarks) {
    const std::size_t begin = std::min(remark.find_first_not_of(' '), remark.size());
    if (remark.compare(begin, key.size(), key) == 0) texts.push_back(remark.substr(begin + key.size()));
  }
  return texts;
}

std::optional<RootTransform> lattice_of(const PlyHeader& header) {
  for (const std::string& text : remarks_of(header, LATTICE))
    if (const auto n = split_numbers(text, ' ', 4); !n.empty() && n[3] > 0.0)
      return RootTransform{{n[0], n[1], n[2]}, n[3]};
  return {};
}

/// "NOISE STEP X Y Z NAME", with "- - -" in the place of a sensor that is not known.
std::optional<Station> station_of(const std::string& text) {
  std::size_t name = 0;
  for (int blank = 0; blank < 5 && name != std::string::npos; ++blank) name = text.find(' ', name + 1);
  if (name == std::string::npos) return {};
  const std::size_t sensor = text.find(' ', text.find(' ') + 1);
  const auto quality = split_numbers(text.substr(0, sensor), ' ', 2);
  const auto place = split_numbers(text.substr(sensor + 1, name - sensor - 1), ' ', 3);
  if (quality.empty() || !(quality[0] >= 0.0 && quality[1] >= 0.0)) return {};
  Station station{text.substr(name + 1), {}, 0, 0, quality[0], quality[1]};
  if (!place.empty()) station.sensor_world = glm::dvec3(place[0], place[1], place[2]);
  return station;
}

/// Takes a column's values as words; nothing where there is none such.
std::vector<std::uint32_t> take_words(Points& points, std::string_view name) {
  std::vector<std::uint32_t> words;
  const Column* column = find_column(points.columns, name);
  if (column == nullptr) return words;
  for (std::size_t i = 0; i < column->size(); ++i)
    words.push_back(static_cast<std::uint32_t>(std::clamp(column->number(i), 0.0, 4294967295.0)));
  std::erase_if(points.columns, [&](const Column& one) { return one.name == name; });
  return words;
}

void take_stations(const PlyHeader& header, Points& points) {
  std::vector<Station> stations;
  for (const std::string& text : remarks_of(header, SCAN))
    if (auto station = station_of(text); station && stations.size() < MOST_STATIONS)
      stations.push_back(*std::move(station));
  if (stations.empty()) return;
  points.stations = std::move(stations);
  points.station.clear();
  if (const Column* scan = find_column(points.columns, COLUMN_SCAN))
    for (std::size_t i = 0; i < scan->size(); ++i)
      points.station.push_back(static_cast<std::uint16_t>(
          std::clamp(scan->number(i), 0.0, static_cast<double>(points.stations.size() - 1))));
}

}  // namespace

bool has_splats(const PlyHeader& header) { return lattice_of(header).has_value(); }

void take_remarks(const PlyHeader& header, Points& points) {
  for (const std::string& text : remarks_of(header, CRS)) points.crs = text;
  points.lattice = lattice_of(header);
  if (!points.lattice) return;
  for (const std::string& text : remarks_of(header, UP))
    if (const auto n = split_numbers(text, ' ', 3); !n.empty() && (n[0] != 0.0 || n[1] != 0.0 || n[2] != 0.0))
      points.up = glm::dvec3(n[0], n[1], n[2]);
  points.field_words = take_words(points, "splat_field");
  points.clip_words = take_words(points, "splat_clip");
  take_stations(header, points);
}

}  // namespace splatray
