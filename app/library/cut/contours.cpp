#include "app/library/cut/contours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace splatray {
namespace {

/// An edge between the centres of two cells: the first one's column and row, and whether the other is below it, else to its right.
struct Edge {
  std::uint32_t column, row;
  bool is_down;

  auto operator<=>(const Edge&) const = default;
};

/// What leads on from each edge, of one level.
using Steps = std::map<Edge, Edge>;

/// The contours of one square between the centres of four cells, its corners clockwise from the top left.
class Square {
 public:
  Square(const HeightRaster& raster, std::uint32_t column, std::uint32_t row)
      : heights_{raster.at(column, row), raster.at(column + 1, row), raster.at(column + 1, row + 1),
                 raster.at(column, row + 1)},
        // The edge of each corner to the next one.
        edges_{Edge{column, row, false}, Edge{column + 1, row, true}, Edge{column, row + 1, false},
               Edge{column, row, true}} {
    low_ = *std::min_element(heights_.begin(), heights_.end());
    high_ = *std::max_element(heights_.begin(), heights_.end());
  }

  [[nodiscard]] bool is_whole() const {
    return std::none_of(heights_.begin(), heights_.end(), [](double height) { return std::isnan(height); });
  }
  [[nodiscard]] double low() const { return low_; }
  [[nodiscard]] double high() const { return high_; }

  /// A contour enters where the way around the square, clockwise, goes down, and leaves where it goes up: at the next such edge
  /// or, where the middle of a saddle is low, at the one before.
  void add_steps(double level, Steps& steps) const {
    double middle = 0.0;
    for (const double height : heights_) middle += 0.25 * height;
    const std::size_t way = middle >= level ? 1 : 3;
    for (std::size_t i = 0; i < 4; ++i) {
      if (!(is_high(i, level) && !is_high(i + 1, level))) continue;
      std::size_t other = (i + way) % 4;
      while (is_high(other, level) || !is_high(other + 1, level)) other = (other + way) % 4;
      steps.emplace(edges_[i], edges_[other]);
    }
  }

 private:
  [[nodiscard]] bool is_high(std::size_t corner, double level) const { return heights_[corner % 4] >= level; }

  std::array<double, 4> heights_;
  std::array<Edge, 4> edges_;
  double low_ = 0.0, high_ = 0.0;
};

glm::dvec2 crossing(const HeightRaster& raster, const Edge& edge, double level) {
  const std::uint32_t column = edge.column + (edge.is_down ? 0 : 1), row = edge.row + (edge.is_down ? 1 : 0);
  const double first = raster.at(edge.column, edge.row), second = raster.at(column, row);
  const double part = (level - first) / (second - first);
  const glm::dvec2 at(edge.column + (edge.is_down ? 0.0 : part), edge.row + (edge.is_down ? part : 0.0));
  return raster.corner + (at + 0.5) * raster.cell * glm::dvec2(1.0, -1.0);
}

/// Takes the way from an edge on out of the steps.
CutCurve curve_from(const HeightRaster& raster, const Edge& first, double level, Steps& steps) {
  CutCurve curve{{crossing(raster, first, level)}, false};
  for (auto step = steps.find(first); step != steps.end();) {
    const Edge next = step->second;
    steps.erase(step);
    curve.closed = next == first;
    if (curve.closed) return curve;
    curve.points.push_back(crossing(raster, next, level));
    step = steps.find(next);
  }
  return curve;
}

/// Open ones from where they begin, then closed ones.
void add_curves(const HeightRaster& raster, double level, Steps& steps, std::vector<Contour>& contours) {
  std::map<Edge, bool> begins;
  for (const auto& [from, to] : steps) {
    begins.emplace(from, true);
    begins[to] = false;
  }
  for (const auto& [from, to] : steps) begins[to] = false;
  for (const auto& [edge, is_begin] : begins)
    if (is_begin) contours.push_back({level, curve_from(raster, edge, level, steps)});
  while (!steps.empty())
    contours.push_back({level, curve_from(raster, Edge(steps.begin()->first), level, steps)});
}

}  // namespace

std::vector<Contour> contours_of(const HeightRaster& raster, double interval, double step) {
  std::map<std::int64_t, Steps> levels;
  for (std::uint32_t row = 0; row + 1 < raster.height; ++row)
    for (std::uint32_t column = 0; column + 1 < raster.width; ++column) {
      const Square square(raster, column, row);
      if (!square.is_whole() || square.high() - square.low() > step) continue;
      const auto first = static_cast<std::int64_t>(std::floor(square.low() / interval)) + 1;
      for (std::int64_t level = first; static_cast<double>(level) * interval <= square.high(); ++level)
        square.add_steps(static_cast<double>(level) * interval, levels[level]);
    }
  std::vector<Contour> contours;
  for (auto& [level, steps] : levels)
    add_curves(raster, static_cast<double>(level) * interval, steps, contours);
  return contours;
}

}  // namespace splatray
