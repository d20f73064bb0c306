#include "preprocess/base/splat_marks.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "engine/base/number_text.h"

namespace splatray {
namespace {

constexpr std::string_view LATTICE = "splatray lattice", UP = "splatray up", SCAN = "splatray scan",
                           CRS = "crs";
constexpr std::string_view MARK_KEYS[] = {LATTICE, UP, SCAN, CRS};
constexpr std::size_t MOST_STATIONS = 65535;

/// The text as one line: what would end it, as line breaks in well-known text do, is a blank.
SplatMark mark(std::string_view key, std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7F; }, ' ');
  return {std::string(key), std::move(text)};
}

/// The texts of a key.
std::vector<std::string> texts_of(const std::vector<SplatMark>& marks, std::string_view key) {
  std::vector<std::string> texts;
  for (const SplatMark& mark : marks)
    if (mark.key == key) texts.push_back(mark.text);
  return texts;
}

std::optional<RootTransform> lattice_of(const std::vector<SplatMark>& marks) {
  for (const std::string& text : texts_of(marks, LATTICE))
    if (const auto n = split_numbers(text, ' ', 4); !n.empty() && n[3] > 0.0)
      return RootTransform{{n[0], n[1], n[2]}, n[3]};
  return {};
}

std::string text_of(const Station& station) {
  const std::string sensor = station.sensor_world ? number_text(*station.sensor_world, ' ') : "- - -";
  return number_text(station.noise_world) + ' ' + number_text(station.step_world) + ' ' + sensor + ' ' +
         station.name;
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

void take_stations(const std::vector<SplatMark>& marks, Points& points) {
  std::vector<Station> stations;
  for (const std::string& text : texts_of(marks, SCAN))
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

std::vector<SplatMark> splat_marks(const Scene& scene, bool splats_alone) {
  std::vector<SplatMark> marks;
  if (splats_alone)
    marks.push_back(
        mark(LATTICE, number_text(scene.root.origin_world, ' ') + ' ' + number_text(scene.root.unit_world)));
  marks.push_back(mark(UP, number_text(scene.up, ' ')));
  for (const Station& station : scene.stations) marks.push_back(mark(SCAN, text_of(station)));
  if (!scene.crs.empty()) marks.push_back(mark(CRS, scene.crs));
  return marks;
}

bool is_mark_key(std::string_view key) {
  return std::find(std::begin(MARK_KEYS), std::end(MARK_KEYS), key) != std::end(MARK_KEYS);
}

std::optional<SplatMark> mark_of(std::string_view comment) {
  comment.remove_prefix(std::min(comment.find_first_not_of(' '), comment.size()));
  for (const std::string_view key : MARK_KEYS)
    if (comment.starts_with(key) && comment.substr(key.size()).starts_with(' '))
      return SplatMark{std::string(key), std::string(comment.substr(key.size() + 1))};
  return {};
}

bool has_splats(const std::vector<SplatMark>& marks) { return lattice_of(marks).has_value(); }

void take_marks(const std::vector<SplatMark>& marks, Points& points) {
  for (const std::string& text : texts_of(marks, CRS)) points.crs = text;
  for (const std::string& text : texts_of(marks, UP))
    if (const auto n = split_numbers(text, ' ', 3); !n.empty() && (n[0] != 0.0 || n[1] != 0.0 || n[2] != 0.0))
      points.up = glm::dvec3(n[0], n[1], n[2]);
  take_stations(marks, points);
  points.lattice = lattice_of(marks);
  if (!points.lattice) return;
  points.field_words = take_words(points, SPLAT_WORDS[0]);
  points.clip_words = take_words(points, SPLAT_WORDS[1]);
}

}  // namespace splatray
