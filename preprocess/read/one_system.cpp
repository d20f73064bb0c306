#include "preprocess/read/one_system.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "engine/base/crs.h"
#include "engine/base/error.h"
#include "preprocess/base/far_points.h"

namespace splatray {
namespace {

constexpr double WIDEST_GAP = 1000.0;  // between scans, in units of what lies on either side

/// A scan's extent along one axis.
struct Interval {
  double low, high;
  const NamedScan* scan;
};

[[noreturn]] void refuse(const NamedScan& a, const NamedScan& b, const std::string& found) {
  throw Error(ExitCode::input_unreadable, a.path.string() + ", " + b.path.string() + ": found " + found +
                                              ", expected scans in one coordinate system");
}

void require_one_unit(const std::vector<NamedScan>& scans) {
  const auto find = [&](bool degrees) {
    return std::find_if(scans.begin(), scans.end(),
                        [=](const NamedScan& scan) { return scan.file.in_degrees == degrees; });
  };
  const auto lengths = find(false), degrees = find(true);
  if (lengths != scans.end() && degrees != scans.end())
    refuse(*lengths, *degrees, "x and y in lengths in the one and in degrees in the other");
}

/// The box of the points but those far from all others.
Bounds box_of(const std::vector<glm::dvec3>& positions) {
  std::vector<glm::dvec3> finite;
  std::copy_if(positions.begin(), positions.end(), std::back_inserter(finite),
               [](const glm::dvec3& p) { return glm::dot(p, p) < INFINITY; });
  return find_far_points(finite).others;
}

void require_no_gap(std::vector<Interval> intervals) {
  std::sort(intervals.begin(), intervals.end(),
            [](const Interval& a, const Interval& b) { return a.low < b.low; });
  double high = -INFINITY, last_high = -INFINITY;
  for (const Interval& one : intervals) last_high = std::max(last_high, one.high);
  for (std::size_t i = 0; i + 1 < intervals.size(); ++i) {
    high = std::max(high, intervals[i].high);
    const double gap = intervals[i + 1].low - high;
    const double before = high - intervals.front().low, behind = last_high - intervals[i + 1].low;
    if (!(gap > WIDEST_GAP * std::max(before, behind)) || !(std::max(before, behind) > 0.0)) continue;
    std::array<char, 96> text{};
    std::snprintf(text.data(), text.size(), "points %.3g apart, which are %.3g across at most", gap,
                  std::max(before, behind));
    refuse(*intervals[i].scan, *intervals[i + 1].scan, text.data());
  }
}

}  // namespace

void require_one_system(const std::vector<NamedScan>& scans) {
  if (scans.size() < 2) return;
  require_one_unit(scans);
  std::array<std::vector<Interval>, 3> intervals;
  for (const NamedScan& scan : scans) {
    const Bounds box = box_of(scan.file.points.position);
    for (int axis = 0; axis < 3 && box.low.x <= box.high.x; ++axis)
      intervals[static_cast<std::size_t>(axis)].push_back({box.low[axis], box.high[axis], &scan});
  }
  for (std::vector<Interval>& along : intervals) require_no_gap(std::move(along));
}

std::string one_crs(const std::vector<NamedCrs>& files, std::vector<std::string>& notes) {
  const auto first =
      std::find_if(files.begin(), files.end(), [](const NamedCrs& file) { return !file.crs.empty(); });
  if (first == files.end()) return "";
  const auto other = std::find_if(first, files.end(), [&](const NamedCrs& file) {
    return !file.crs.empty() && !is_same_crs(first->crs, file.crs);
  });
  if (other == files.end()) return first->crs;
  notes.push_back(first->path.string() + ", " + other->path.string() + ": found the coordinate systems '" +
                  describe_crs(first->crs).name + "' and '" + describe_crs(other->crs).name +
                  "', expected one; the scene's is left unknown");
  return "";
}

}  // namespace splatray
