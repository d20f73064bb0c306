#include "preprocess/read/join_scans.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/release.h"
#include "engine/base/srgb.h"
#include "engine/base/utf8.h"
#include "preprocess/base/point_arrays.h"
#include "preprocess/read/scan/missing_attributes.h"
#include "preprocess/read/scan/stored_colors.h"

namespace splatray {
namespace {

bool has_unjudged_colors(const Points& points) {
  return !points.stored_color.empty() && points.stored_color_most == 0;
}

/// Decides what the colours of unknown scale are, from all of them; which of 16 bits are 8 in the high byte each file says alone.
void judge_colors(std::vector<NamedScan>& scans, std::vector<std::string>& notes) {
  ColorRange all;
  std::vector<ColorRange> ranges(scans.size());
  for (std::size_t i = 0; i < scans.size(); ++i) {
    if (has_unjudged_colors(scans[i].file.points)) ranges[i].add(scans[i].file.points.stored_color);
    all.add(ranges[i]);
  }
  if (const std::string said = color_note(all); !said.empty()) notes.push_back(said);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    Points& points = scans[i].file.points;
    if (!has_unjudged_colors(points)) continue;
    const bool is_high = all.full() >= HIGH_BYTES_FULL && ranges[i].full() == HIGH_BYTES_FULL;
    points.stored_color_most =
        static_cast<std::uint16_t>(is_high ? HIGH_BYTES_FULL : std::max(all.full(), 255.0));
    if (all.is_black()) {
      notes.push_back(path_text(scans[i].path) + ": its colours are all black and were left out");
      release(points.stored_color);
    }
  }
}

/// `color` from `stored_color`, which is freed.
void decode_colors(Points& points) {
  if (points.stored_color.empty()) return;
  std::vector<float> linear(std::size_t{points.stored_color_most} + 1);
  for (std::size_t i = 0; i < linear.size(); ++i)
    linear[i] = srgb_to_linear(static_cast<float>(i) / static_cast<float>(points.stored_color_most));
  const auto decoded = [&](std::uint16_t value) {
    return linear[std::min<std::size_t>(value, linear.size() - 1)];
  };
  points.color.resize(points.stored_color.size());
  tbb::parallel_for(std::size_t{0}, points.color.size(), [&](std::size_t i) {
    const glm::u16vec3& stored = points.stored_color[i];
    points.color[i] = {decoded(stored.x), decoded(stored.y), decoded(stored.z)};
  });
  release(points.stored_color);
}

/// A file that knows nothing of where it was measured from is one station too.
void name_stations(NamedScan& scan) {
  std::vector<Station>& stations = scan.file.points.stations;
  if (stations.empty()) stations.resize(1);
  for (std::size_t i = 0; i < stations.size(); ++i) {
    std::string& name = stations[i].name;
    if (name.empty()) name = scan.name + (stations.size() > 1 ? " " + std::to_string(i + 1) : "");
  }
}

void append_scans_points(Points& to, Points&& more) {
  if (!to.stations.empty() && more.station.empty()) more.station.resize(more.size(), 0);
  for (std::uint16_t& station : more.station)
    station = static_cast<std::uint16_t>(station + to.stations.size());
  to.stations.insert(to.stations.end(), std::make_move_iterator(more.stations.begin()),
                     std::make_move_iterator(more.stations.end()));
  append_points(to, std::move(more));
}

bool is_constant_zero(const Column& column) {
  return std::visit(
      [](const auto& list) { return std::all_of(list.begin(), list.end(), [](auto v) { return v == 0; }); },
      column.values);
}

}  // namespace

InputObject join_scans(std::vector<NamedScan> scans, std::vector<std::string>& notes,
                       const std::vector<std::string>& asked) {
  judge_colors(scans, notes);
  InputObject object;
  object.name = scans.size() == 1 ? scans.front().name : "scans";
  std::size_t stations = 0;
  for (NamedScan& scan : scans) {
    name_stations(scan);
    stations += scan.file.points.stations.size();
  }
  if (stations > 0xFFFF)
    throw Error(ExitCode::input_unreadable,
                "the input has " + std::to_string(stations) + " scans, expected at most 65535");
  for (NamedScan& scan : scans) {
    decode_colors(scan.file.points);
    append_scans_points(object.points, std::move(scan.file.points));
  }
  Points& points = object.points;
  std::erase_if(points.columns, [&asked](const Column& column) {
    return is_constant_zero(column) && !is_asked_for(asked, column.name);
  });
  if (stations > 1) {
    points.station.resize(points.size(), 0);  // where all points are of the first station it is still empty
    points.columns.push_back({std::string(COLUMN_SCAN), points.station});
  }
  object.material = default_material(!points.color.empty());
  return object;
}

}  // namespace splatray
