#include "app/library/cut/cut_hatch.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace splatray {
namespace {

/// Unit vectors along the lines and across them, to their left.
struct LineAxes {
  explicit LineAxes(const HatchStyle& style)
      : along(glm::normalize(style.along)), across(-along.y, along.x) {}
  glm::dvec2 along, across;
};

/// Where a line of the hatch crosses a curve.
struct Crossing {
  double at;            ///< along the line
  bool is_back_before;  ///< the curve's back is before it, else behind it
};
/// By the number of the line, which is `spacing` times that from the origin.
using Crossings = std::map<std::int64_t, std::vector<Crossing>>;

double length_of(const CutCurve& curve) {
  double length = 0.0;
  for (std::size_t i = 1; i < curve.points.size(); ++i)
    length += glm::distance(curve.points[i - 1], curve.points[i]);
  return length;
}

/// Each line crosses a segment from its lower end up to its upper one, without that, so that curves are crossed once at their corners.
void cross(const glm::dvec2& from, const glm::dvec2& to, const LineAxes& axes, double spacing,
           Crossings& crossings) {
  const double begin = glm::dot(from, axes.across) / spacing, end = glm::dot(to, axes.across) / spacing;
  if (begin == end) return;
  const auto first = static_cast<std::int64_t>(std::ceil(std::min(begin, end)));
  for (std::int64_t line = first; static_cast<double>(line) < std::max(begin, end); ++line) {
    const double part = (static_cast<double>(line) - begin) / (end - begin);
    // A curve that goes on to higher numbers has its left, which is its front, before it along the line.
    crossings[line].push_back({glm::dot(glm::mix(from, to, part), axes.along), end < begin});
  }
}

class HatchLine {
 public:
  HatchLine(std::int64_t number, const LineAxes& axes, const HatchStyle& style,
            std::vector<std::array<glm::dvec2, 2>>& lines)
      : along_(axes.along),
        across_(static_cast<double>(number) * style.spacing * axes.across),
        style_(style),
        lines_(lines) {}

  void add_all(const std::vector<Crossing>& crossings) {
    if (crossings.front().is_back_before) add(crossings.front().at - style_.stub, crossings.front().at);
    for (std::size_t i = 1; i < crossings.size(); ++i) add_between(crossings[i - 1], crossings[i]);
    if (!crossings.back().is_back_before) add(crossings.back().at, crossings.back().at + style_.stub);
  }

 private:
  void add_between(const Crossing& first, const Crossing& second) {
    const double length = second.at - first.at, stub = std::min(style_.stub, 0.5 * length);
    const bool from_back = !first.is_back_before, to_back = second.is_back_before;
    if (from_back && to_back && length <= style_.thickest) return add(first.at, second.at);
    if (from_back) add(first.at, first.at + stub);
    if (to_back) add(second.at - stub, second.at);
  }
  void add(double from, double to) {
    if (!(to > from)) return;
    lines_.push_back({across_ + from * along_, across_ + to * along_});
  }

  glm::dvec2 along_, across_;
  const HatchStyle& style_;
  std::vector<std::array<glm::dvec2, 2>>& lines_;
};

}  // namespace

std::vector<std::array<glm::dvec2, 2>> cut_hatch(std::span<const CutCurve> curves, const HatchStyle& style) {
  const LineAxes axes(style);
  Crossings crossings;
  for (const CutCurve& curve : curves) {
    const std::size_t count = curve.points.size();
    if (!curve.closed && length_of(curve) < style.thickest) continue;
    for (std::size_t i = curve.closed ? 0 : 1; i < count; ++i)
      cross(curve.points[(i + count - 1) % count], curve.points[i], axes, style.spacing, crossings);
  }
  std::vector<std::array<glm::dvec2, 2>> lines;
  for (auto& [number, line] : crossings) {
    std::sort(line.begin(), line.end(), [](const Crossing& a, const Crossing& b) { return a.at < b.at; });
    HatchLine(number, axes, style, lines).add_all(line);
  }
  return lines;
}

}  // namespace splatray
