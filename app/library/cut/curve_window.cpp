#include "app/library/cut/curve_window.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace splatray {
namespace {

/// The part of a line from `from` (0) to `to` (1) that lies in the rectangle.
std::optional<std::array<double, 2>> part_within(const glm::dvec2& from, const glm::dvec2& to,
                                                 const glm::dvec2& low, const glm::dvec2& high) {
  double begin = 0.0, end = 1.0;
  for (int axis = 0; axis < 2; ++axis) {
    const double way = to[axis] - from[axis];
    if (way == 0.0) {
      if (from[axis] < low[axis] || from[axis] > high[axis]) return {};
      continue;
    }
    const double to_low = (low[axis] - from[axis]) / way, to_high = (high[axis] - from[axis]) / way;
    begin = std::max(begin, std::min(to_low, to_high));
    end = std::min(end, std::max(to_low, to_high));
  }
  if (!(begin < end)) return {};
  return std::array{begin, end};
}

}  // namespace

std::vector<CutCurve> curve_within(const CutCurve& curve, const glm::dvec2& low, const glm::dvec2& high) {
  const auto holds = [&](const glm::dvec2& at) {
    return at.x >= low.x && at.y >= low.y && at.x <= high.x && at.y <= high.y;
  };
  if (std::all_of(curve.points.begin(), curve.points.end(), holds)) return {curve};
  std::vector<CutCurve> parts;
  const std::size_t count = curve.points.size();
  bool goes_on = false;
  for (std::size_t i = 1; i < count + (curve.closed ? 1 : 0); ++i) {
    const glm::dvec2 &from = curve.points[i - 1], &to = curve.points[i % count];
    const auto part = part_within(from, to, low, high);
    if (part) {
      if (!goes_on) parts.push_back({{glm::mix(from, to, (*part)[0])}, false, curve.radius});
      parts.back().points.push_back(glm::mix(from, to, (*part)[1]));
    }
    goes_on = part && (*part)[1] == 1.0;
  }
  // A closed curve that begins within goes on from its end.
  if (curve.closed && parts.size() > 1 && goes_on && holds(curve.points.front())) {
    std::vector<glm::dvec2>& last = parts.back().points;
    last.insert(last.end(), parts.front().points.begin() + 1, parts.front().points.end());
    parts.front() = std::move(parts.back());
    parts.pop_back();
  }
  return parts;
}

}  // namespace splatray
