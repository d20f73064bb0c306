#include "preprocess/read/text/read_track.h"

#include <algorithm>
#include <utility>

#include "preprocess/read/bytes/byte_reader.h"
#include "preprocess/read/text/read_xyz.h"

namespace splatray {

std::vector<TrackPlace> read_track(const std::filesystem::path& path, const ReadListener& listener) {
  ReadOptions options;
  std::vector<std::string> unheard;  // what is odd in a first try is not of interest
  Points points = read_xyz(path, options, {unheard, listener.progress, listener.begin, listener.end}).points;
  if (find_column(points.columns, COLUMN_TIME) == nullptr) {
    options.scans.columns = "time,x,y,z";
    points = read_xyz(path, options, listener).points;
  }
  const Column* time = find_column(points.columns, COLUMN_TIME);
  if (points.size() == 0 || time == nullptr)
    throw_unreadable(path, "found no times and places, expected a line of time, x, y, z for each");
  std::vector<TrackPlace> track(points.size());
  for (std::size_t i = 0; i < track.size(); ++i) track[i] = {time->number(i), points.position[i]};
  std::stable_sort(track.begin(), track.end(),
                   [](const TrackPlace& a, const TrackPlace& b) { return a.time < b.time; });
  if (!(track.front().time < track.back().time))
    throw_unreadable(path, "found one time alone, expected times that ascend along the way");
  return track;
}

}  // namespace splatray
