#include "app/library/cut/polyline_fit.h"

#include <algorithm>
#include <cmath>

#include "app/library/cut/cut_join.h"

namespace splatray {
namespace {

constexpr double LEAST_CROSSING = 0.2;  ///< between parts whose lines' crossing says where they meet

/// The line that fits points best.
struct FittedLine {
  glm::dvec2 middle{0.0}, along{1.0, 0.0};

  [[nodiscard]] glm::dvec2 nearest(const glm::dvec2& point) const {
    return middle + glm::dot(point - middle, along) * along;
  }
};

/// By total least squares, of the points from `first` to `last`, and both.
FittedLine fitted_line(const std::vector<glm::dvec2>& points, std::size_t first, std::size_t last) {
  FittedLine line;
  const auto count = static_cast<double>(last - first + 1);
  for (std::size_t i = first; i <= last; ++i) line.middle += points[i] / count;
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (std::size_t i = first; i <= last; ++i) {
    const glm::dvec2 to = points[i] - line.middle;
    xx += to.x * to.x;
    xy += to.x * to.y;
    yy += to.y * to.y;
  }
  const double turn = 0.5 * std::atan2(2.0 * xy, xx - yy);
  line.along = {std::cos(turn), std::sin(turn)};
  return line;
}

/// Where two parts meet, which were divided at `corner`.
glm::dvec2 meeting(const FittedLine& first, const FittedLine& second, const glm::dvec2& corner,
                   double tolerance) {
  const double sine = first.along.x * second.along.y - first.along.y * second.along.x;
  const glm::dvec2 between = second.middle - first.middle;
  if (std::abs(sine) > LEAST_CROSSING) {
    const double on = (between.x * second.along.y - between.y * second.along.x) / sine;
    const glm::dvec2 crossing = first.middle + on * first.along;
    if (glm::distance(crossing, corner) < 3.0 * tolerance) return crossing;
  }
  return 0.5 * (first.nearest(corner) + second.nearest(corner));
}

/// The indices at which the row is divided, its ends among them.
std::vector<std::size_t> divisions(const std::vector<glm::dvec2>& points, double tolerance) {
  const CutCurve kept = simplified({points, false}, tolerance);
  std::vector<std::size_t> found;
  std::size_t i = 0;
  for (const glm::dvec2& point : kept.points) {
    while (points[i] != point) ++i;
    found.push_back(i++);
  }
  return found;
}

/// How points swing about a line, in tolerances.
struct Swings {
  double most = 0.0;                           ///< distance from it
  double of_ends = 0.0;                        ///< the same of the first and the last point
  std::size_t alternations = 0;                ///< from one side to the other
  std::size_t beyond = 0, longest_beyond = 0;  ///< points further than one tolerance, and of these in a row
};

Swings swings_of(const std::vector<glm::dvec2>& points, std::size_t first, std::size_t last,
                 double tolerance) {
  constexpr double APART = 0.3;  // from the line: nearer points are on no side of it
  const FittedLine line = fitted_line(points, first, last);
  const glm::dvec2 across(-line.along.y, line.along.x);
  Swings swings;
  double side = 0.0;
  std::size_t run = 0;
  for (std::size_t i = first; i <= last; ++i) {
    const double off = glm::dot(points[i] - line.middle, across) / tolerance;
    swings.most = std::max(swings.most, std::abs(off));
    if (i == first || i == last) swings.of_ends = std::max(swings.of_ends, std::abs(off));
    if (std::abs(off) > APART) {
      swings.alternations += off * side < 0.0 ? 1 : 0;
      side = off;
    }
    run = std::abs(off) > 1.0 ? run + 1 : 0;
    swings.beyond += run > 0 ? 1 : 0;
    swings.longest_beyond = std::max(swings.longest_beyond, run);
  }
  return swings;
}

/// Whether a row is one line though some of it is further than the tolerance from it: rims of discs swing from side to side, often, and a
/// single rim juts out; a curve stays on a side, and so do steps and notches. The row goes on by about a unit a point.
bool is_one_line(const Swings& swings, std::size_t points, double tolerance) {
  constexpr double MOST = 2.5, LEAST_LENGTH = 24.0, SWING = 16.0, JUT = 6.0;  // tolerances
  constexpr double JUTTING = 0.1;                                             // of the row
  const double length = static_cast<double>(points) / tolerance;
  if (swings.most > MOST || length < LEAST_LENGTH) return false;
  const bool swings_often =
      static_cast<double>(swings.alternations) * SWING > length && swings.alternations >= 4;
  const bool juts = swings.of_ends < 1.0 &&
                    static_cast<double>(swings.beyond) < JUTTING * static_cast<double>(points) &&
                    static_cast<double>(swings.longest_beyond) < JUT * tolerance;
  return swings_often || juts;
}

/// Joins parts that are one line.
std::vector<std::size_t> joined_parts(const std::vector<glm::dvec2>& points,
                                      const std::vector<std::size_t>& parts, double tolerance) {
  constexpr double STOP = 4.0;  // tolerances: no longer row is nearer to a line
  std::vector<std::size_t> joined{parts.front()};
  for (std::size_t begin = 0; begin + 1 < parts.size();) {
    std::size_t end = begin + 1;
    for (std::size_t i = end + 1; i < parts.size(); ++i) {
      const Swings swings = swings_of(points, parts[begin], parts[i], tolerance);
      if (swings.most > STOP) break;
      if (is_one_line(swings, parts[i] - parts[begin] + 1, tolerance)) end = i;
    }
    joined.push_back(parts[end]);
    begin = end;
  }
  return joined;
}

}  // namespace

std::vector<glm::dvec2> fitted_polyline(const std::vector<glm::dvec2>& points, bool closed,
                                        double tolerance) {
  if (points.size() < 3) return points;
  std::vector<glm::dvec2> row = points;
  if (closed) {
    // From a corner on: what is farthest from any place is one.
    const auto farther = [&points](const glm::dvec2& a, const glm::dvec2& b) {
      return glm::distance(a, points.front()) < glm::distance(b, points.front());
    };
    std::rotate(row.begin(), std::max_element(row.begin(), row.end(), farther), row.end());
    row.push_back(row.front());
  }
  const std::vector<std::size_t> parts = joined_parts(row, divisions(row, tolerance), tolerance);
  std::vector<FittedLine> lines;
  for (std::size_t i = 1; i < parts.size(); ++i) lines.push_back(fitted_line(row, parts[i - 1], parts[i]));
  std::vector<glm::dvec2> corners;
  if (!closed) corners.push_back(lines.front().nearest(row.front()));
  if (closed && lines.size() > 1)
    corners.push_back(meeting(lines.back(), lines.front(), row.front(), tolerance));
  for (std::size_t i = 1; i < lines.size(); ++i)
    corners.push_back(meeting(lines[i - 1], lines[i], row[parts[i]], tolerance));
  if (!closed) corners.push_back(lines.back().nearest(row.back()));
  return corners;
}

}  // namespace splatray
