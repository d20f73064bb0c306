#include "preprocess/read/scan/no_data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/number_text.h"
#include "preprocess/base/point_arrays.h"

namespace splatray {
namespace {

/// Others are nearer to each other than to it by this factor, in all axes: a floor at 0 below a room is not.
constexpr double FAR = 3.0;
constexpr std::size_t LEAST_SHARED = 2;
constexpr std::size_t LEAST_OTHERS = 3;

/// One end of an axis: its value, how many share it, and the next value.
struct End {
  double value = 0.0;
  double next = 0.0;
  std::size_t count = 0;
};

/// Adds a value to an end, which is the least where `sign` is 1, the greatest where it is -1.
void add(End& end, double value, double sign) {
  if (end.count == 0 || sign * value < sign * end.value) {
    end.next = end.count == 0 ? value : end.value;
    end.value = value;
    end.count = 1;
  } else if (value == end.value) {
    ++end.count;
  } else if (end.next == end.value || sign * value < sign * end.next) {
    end.next = value;
  }
}

struct Axis {
  End low, high;
};

std::array<Axis, 3> axes_of(const std::vector<glm::dvec3>& positions) {
  std::array<Axis, 3> axes;
  for (const glm::dvec3& place : positions)
    for (int axis = 0; axis < 3; ++axis) {
      add(axes[static_cast<std::size_t>(axis)].low, place[axis], 1.0);
      add(axes[static_cast<std::size_t>(axis)].high, place[axis], -1.0);
    }
  return axes;
}

/// Whether programs write the value for "no data": GDAL, ESRI, LAStools, Surfer.
bool is_sentinel(double value) {
  constexpr double KNOWN[] = {9999.0,  99999.0, 999999.0,     9999999.0,
                              32767.0, 32768.0, 2147483647.0, 2147483648.0};
  constexpr double HUGE_VALUE = 1e10;
  const double size = std::fabs(value);
  return size >= HUGE_VALUE || std::find(std::begin(KNOWN), std::end(KNOWN), size) != std::end(KNOWN);
}

/// The range of an axis without the end in question, `high` or not.
double range_without(const Axis& axis, bool high) {
  return high ? axis.high.next - axis.low.value : axis.high.value - axis.low.next;
}

/// A coordinate that stands for "no data".
struct NoData {
  int axis = 0;
  double value = 0.0;
};

std::optional<NoData> find_no_data(const std::vector<glm::dvec3>& positions) {
  const std::array<Axis, 3> axes = axes_of(positions);
  // Rows without data share it in several axes, as 0 0 0 does: an axis counts as it is without its own end that is far.
  double longest = 0.0;
  for (const Axis& axis : axes) {
    double range = axis.high.value - axis.low.value;
    for (const bool high : {false, true}) {
      const double without = range_without(axis, high);
      if (range - without > FAR * without && without > 0.0) range = without;
    }
    longest = std::max(longest, range);
  }
  for (int a = 0; a < 3; ++a) {
    const Axis& axis = axes[static_cast<std::size_t>(a)];
    for (const bool high : {false, true}) {
      const End& end = high ? axis.high : axis.low;
      const double gap = std::fabs(end.value - end.next);
      const double needed = is_sentinel(end.value) ? range_without(axis, high) : FAR * longest;
      const bool shared = end.count >= LEAST_SHARED && positions.size() - end.count >= LEAST_OTHERS;
      if (shared && gap > needed && longest > 0.0) return NoData{a, end.value};
    }
  }
  return {};
}

template <typename Value>
void keep(std::vector<Value>& list, const std::vector<bool>& kept) {
  if (list.size() != kept.size()) return;
  std::size_t to = 0;
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (kept[i]) list[to++] = list[i];
  list.resize(to);
}

}  // namespace

void remove_no_data(const std::filesystem::path& path, Points& points, ScanCounts& counts,
                    const ReadListener& listener) {
  constexpr int MOST_VALUES = 6;  // two ends of three axes
  constexpr char AXES[] = {'x', 'y', 'z'};
  if (points.lattice) return;  // splats were points that were looked at
  for (int round = 0; round < MOST_VALUES; ++round) {
    const std::optional<NoData> found = find_no_data(points.position);
    if (!found) return;
    std::vector<bool> kept(points.size());
    for (std::size_t i = 0; i < kept.size(); ++i) kept[i] = points.position[i][found->axis] != found->value;
    const std::size_t before = points.size();
    for_each_array(points, [&](auto& values) { keep(values, kept); });
    counts.no_return += before - points.size();
    listener.note(path, std::to_string(before - points.size()) + " points whose " + AXES[found->axis] +
                            " is " + number_text(found->value) +
                            ", far from all others, are taken as without data and left out");
  }
}

}  // namespace splatray
