#include "preprocess/voronoi.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

namespace splatray {
namespace {

constexpr std::size_t OCTAGON = 8;
constexpr std::size_t MAX_NEIGHBOURS = 64;
constexpr std::size_t RING = 6;
constexpr double OCTAGON_APOTHEM = 2.0;  // in units of the distance to the RING-th neighbour
constexpr double OPEN_REACH = 0.65;      // where the cell is open, in units of its neighbours' mean distance
constexpr int OCTAGON_EDGE = -1;

/// A corner of the cell and the edge from it to the next corner: the neighbour that cut it, or OCTAGON_EDGE.
struct Corner {
  glm::dvec2 place;
  int edge;
};

/// A convex polygon around the origin, counter-clockwise.
class Cell {
 public:
  explicit Cell(double apothem) : size_(OCTAGON) {
    const double circumradius = apothem / std::cos(std::numbers::pi / OCTAGON);
    for (std::size_t i = 0; i < OCTAGON; ++i) {
      const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / OCTAGON;
      corners_[i] = {circumradius * glm::dvec2(std::cos(angle), std::sin(angle)), OCTAGON_EDGE};
    }
  }

  [[nodiscard]] std::span<const Corner> corners() const { return std::span(corners_).first(size_); }

  [[nodiscard]] double reach() const {
    double squared = 0.0;
    for (const Corner& corner : corners()) squared = std::max(squared, glm::dot(corner.place, corner.place));
    return std::sqrt(squared);
  }

  /// Keeps what is nearer to the origin than to the neighbour. Returns whether anything was cut.
  bool clip(const glm::dvec2& neighbour, int edge) {
    const auto beyond = [&](const Corner& corner) {
      return glm::dot(corner.place, neighbour) - 0.5 * glm::dot(neighbour, neighbour);
    };
    std::array<Corner, OCTAGON + MAX_NEIGHBOURS + 1> kept;
    std::size_t count = 0;
    bool cut = false;
    for (std::size_t i = 0; i < size_; ++i) {
      const Corner& here = corners_[i];
      const Corner& next = corners_[i + 1 < size_ ? i + 1 : 0];
      const double a = beyond(here);
      const double b = beyond(next);
      cut = cut || a > 0.0;
      if (a <= 0.0) kept[count++] = here;
      if ((a <= 0.0) == (b <= 0.0)) continue;
      const glm::dvec2 crossing = here.place + (next.place - here.place) * (a / (a - b));
      kept[count++] = {crossing, a <= 0.0 ? edge : here.edge};
    }
    if (cut) std::copy_n(kept.begin(), size_ = count, corners_.begin());
    return cut;
  }

 private:
  std::array<Corner, OCTAGON + MAX_NEIGHBOURS + 1> corners_;
  std::size_t size_;
};

}  // namespace

VoronoiReach voronoi_reach(std::span<const TangentNeighbour> neighbours) {
  assert(neighbours.size() <= MAX_NEIGHBOURS);
  if (neighbours.empty()) return {0.0, 0.0};
  Cell cell(OCTAGON_APOTHEM * neighbours[std::min(RING, neighbours.size()) - 1].distance);
  double decisive = 2.0 * cell.reach();
  for (std::size_t j = 0; j < neighbours.size() && neighbours[j].distance < decisive; ++j) {
    if (cell.clip(neighbours[j].place, static_cast<int>(j))) decisive = 2.0 * cell.reach();
  }
  double closed_squared = 0.0;
  double distance_sum = 0.0;
  std::size_t bounding = 0;
  bool open = false;
  int previous_edge = cell.corners().back().edge;
  for (const Corner& corner : cell.corners()) {
    const bool at_octagon = corner.edge == OCTAGON_EDGE || previous_edge == OCTAGON_EDGE;
    if (!at_octagon) closed_squared = std::max(closed_squared, glm::dot(corner.place, corner.place));
    if (corner.edge != OCTAGON_EDGE)
      distance_sum += neighbours[static_cast<std::size_t>(corner.edge)].distance, ++bounding;
    open = open || at_octagon;
    previous_edge = corner.edge;
  }
  const double open_reach =
      open ? OPEN_REACH * distance_sum / static_cast<double>(std::max<std::size_t>(bounding, 1)) : 0.0;
  return {std::max(std::sqrt(closed_squared), open_reach), decisive};
}

}  // namespace splatray
