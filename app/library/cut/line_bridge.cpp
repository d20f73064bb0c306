#include "app/library/cut/line_bridge.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace splatray {
namespace {

constexpr double ONE_LINE = 0.9;  ///< least cosine between the ways of two ends: 26 degrees

/// An end of an open curve: twice its index, one more for its last point.
struct LooseEnd {
  std::size_t end;
  glm::dvec2 place, out;  ///< out: unit, in which the curve would go on
};

struct Bridge {
  std::size_t a, b;
  double length;
};

/// The direction in which a curve ends, over at least `length` of it where it is that long.
glm::dvec2 way_at_end(const std::vector<glm::dvec2>& points, bool is_last, double length) {
  const std::size_t count = points.size();
  const auto point = [&](std::size_t i) { return is_last ? points[count - 1 - i] : points[i]; };
  std::size_t back = 1;
  while (back + 1 < count && glm::distance(point(0), point(back)) < length) ++back;
  const glm::dvec2 way = point(0) - point(back);
  return glm::length(way) > 0.0 ? glm::normalize(way) : glm::dvec2(0.0);
}

std::vector<Bridge> possible_bridges(const std::vector<CutCurve>& curves, const BridgeReach& reach) {
  std::vector<LooseEnd> ends;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const std::vector<glm::dvec2>& points = curves[i].points;
    if (curves[i].closed || points.size() < 2) continue;
    ends.push_back({2 * i, points.front(), way_at_end(points, false, reach.gap)});
    ends.push_back({2 * i + 1, points.back(), way_at_end(points, true, reach.gap)});
  }
  std::sort(ends.begin(), ends.end(),
            [](const LooseEnd& a, const LooseEnd& b) { return a.place.x < b.place.x; });
  std::vector<Bridge> bridges;
  for (auto a = ends.begin(); a != ends.end(); ++a)
    for (auto b = a + 1; b != ends.end() && b->place.x - a->place.x <= reach.gap; ++b) {
      const glm::dvec2 between = b->place - a->place;
      const double along = glm::dot(between, a->out), length = glm::length(between);
      const double aside = std::abs(between.x * a->out.y - between.y * a->out.x);
      if (a->end / 2 == b->end / 2 || glm::dot(a->out, -b->out) < ONE_LINE) continue;
      if (along > -reach.aside && length <= reach.gap && aside <= reach.aside)
        bridges.push_back({a->end, b->end, length});
    }
  std::stable_sort(bridges.begin(), bridges.end(),
                   [](const Bridge& a, const Bridge& b) { return a.length < b.length; });
  return bridges;
}

}  // namespace

std::vector<CutCurve> bridged(const std::vector<CutCurve>& curves, const BridgeReach& reach) {
  std::vector<std::optional<std::size_t>> next(2 * curves.size());  // of each end: the one behind its bridge
  for (const Bridge& bridge : possible_bridges(curves, reach)) {
    if (next[bridge.a] || next[bridge.b]) continue;
    next[bridge.a] = bridge.b;
    next[bridge.b] = bridge.a;
  }
  std::vector<bool> is_done(curves.size());
  std::vector<CutCurve> whole;
  // First from ends without a bridge, then around.
  for (const bool open : {true, false})
    for (std::size_t start = 0; start < next.size(); ++start) {
      if (is_done[start / 2] || (open && next[start])) continue;
      CutCurve curve{{}, curves[start / 2].closed, curves[start / 2].radius};
      for (std::optional<std::size_t> end = start; end; end = next[*end ^ 1U]) {
        curve.closed = curve.closed || is_done[*end / 2];
        if (is_done[*end / 2]) break;
        is_done[*end / 2] = true;
        std::vector<glm::dvec2> points = curves[*end / 2].points;
        if (*end % 2 == 1) std::reverse(points.begin(), points.end());
        curve.points.insert(curve.points.end(), points.begin(), points.end());
      }
      whole.push_back(std::move(curve));
    }
  return whole;
}

}  // namespace splatray
