#include "app/library/cut/line_doubles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>

namespace splatray {
namespace {

constexpr double MOST_DOUBLE = 0.5;  ///< of a curve
constexpr double SAMPLE = 0.5;       ///< of what is near, from place to place of a curve

std::vector<glm::dvec2> places_along(const CutCurve& curve, double step) {
  std::vector<glm::dvec2> places;
  const std::size_t count = curve.points.size();
  for (std::size_t i = curve.closed ? 0 : 1; i < count; ++i) {
    const glm::dvec2 from = curve.points[(i + count - 1) % count], way = curve.points[i] - from;
    const double parts = std::max(std::ceil(glm::length(way) / step), 1.0);
    for (double part = 0.5; part < parts; ++part) places.push_back(from + part / parts * way);
  }
  return places;
}

/// Places in squares of a side.
class PlaceGrid {
 public:
  explicit PlaceGrid(double side) : side_(side) {}

  void add(const glm::dvec2& place) { cells_[cell_of(place)].push_back(place); }
  /// Whether one lies within the side of a place.
  [[nodiscard]] bool is_near(const glm::dvec2& place) const {
    const PlaceCell middle = cell_of(place);
    for (std::int64_t x = middle[0] - 1; x <= middle[0] + 1; ++x)
      for (std::int64_t y = middle[1] - 1; y <= middle[1] + 1; ++y)
        if (const auto found = cells_.find({x, y}); found != cells_.end())
          for (const glm::dvec2& other : found->second)
            if (glm::distance(other, place) < side_) return true;
    return false;
  }

 private:
  using PlaceCell = std::array<std::int64_t, 2>;

  [[nodiscard]] PlaceCell cell_of(const glm::dvec2& place) const {
    return {static_cast<std::int64_t>(std::floor(place.x / side_)),
            static_cast<std::int64_t>(std::floor(place.y / side_))};
  }

  double side_;
  std::map<PlaceCell, std::vector<glm::dvec2>> cells_;
};

}  // namespace

double curve_length(const CutCurve& curve) {
  double length = curve.closed ? glm::distance(curve.points.front(), curve.points.back()) : 0.0;
  for (std::size_t i = 1; i < curve.points.size(); ++i)
    length += glm::distance(curve.points[i - 1], curve.points[i]);
  return length;
}

std::vector<CutCurve> without_doubles(std::vector<CutCurve> curves, double near) {
  std::stable_sort(curves.begin(), curves.end(),
                   [](const CutCurve& a, const CutCurve& b) { return curve_length(a) > curve_length(b); });
  PlaceGrid drawn(near);
  std::vector<CutCurve> kept;
  for (CutCurve& curve : curves) {
    const std::vector<glm::dvec2> places = places_along(curve, SAMPLE * near);
    const auto doubles = std::count_if(places.begin(), places.end(),
                                       [&drawn](const glm::dvec2& place) { return drawn.is_near(place); });
    if (static_cast<double>(doubles) > MOST_DOUBLE * static_cast<double>(places.size())) continue;
    for (const glm::dvec2& place : places) drawn.add(place);
    kept.push_back(std::move(curve));
  }
  return kept;
}

}  // namespace splatray
