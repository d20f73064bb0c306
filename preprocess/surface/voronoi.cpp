#include "preprocess/surface/voronoi.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

namespace splatray {
namespace {

constexpr std::size_t OCTAGON = 8;
constexpr std::size_t MAX_CUTS = 128;    // neighbours and creases
constexpr double OCTAGON_APOTHEM = 4.0;  // in units of the distance to the EVEN_RING-th neighbour
constexpr double OPEN_REACH = 0.65;      // where the cell is open, in units of its neighbours' mean distance
constexpr double GAP_COSINE = -0.866;  // of 150 degrees: a wider gap between bounding neighbours is a border
constexpr double BORDER_REACH =
    0.8;  // of a border point, in units of the distance to its BORDER_RING-th neighbour
constexpr std::size_t BORDER_RING =
    4;  // neighbours next to a point of a straight border, of the square lattice
constexpr int OCTAGON_EDGE = -1;
constexpr int CREASE_EDGE = -2;

/// A corner of the cell and the edge from it to the next corner: the neighbour that cut it, or OCTAGON_EDGE
/// or CREASE_EDGE.
struct CellCorner {
  glm::dvec2 place;
  int edge;
  glm::dvec2 normal;  ///< of that edge, unit, outwards
};

/// A convex polygon around the origin, counter-clockwise.
class Cell {
 public:
  explicit Cell(double apothem) : corners_(stores_[0]), spare_(stores_[1]), size_(OCTAGON) {
    const double circumradius = apothem / std::cos(std::numbers::pi / OCTAGON);
    for (std::size_t i = 0; i < OCTAGON; ++i) {
      const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / OCTAGON;
      const double middle = angle + std::numbers::pi / OCTAGON;
      corners_[i] = {circumradius * glm::dvec2(std::cos(angle), std::sin(angle)), OCTAGON_EDGE,
                     glm::dvec2(std::cos(middle), std::sin(middle))};
    }
  }

  Cell(const Cell&) = delete;
  Cell& operator=(const Cell&) = delete;

  [[nodiscard]] std::span<const CellCorner> corners() const { return corners_.first(size_); }

  [[nodiscard]] double reach() const {
    double squared = 0.0;
    for (const CellCorner& corner : corners())
      squared = std::max(squared, glm::dot(corner.place, corner.place));
    return std::sqrt(squared);
  }

  /// Keeps the side of a line that the origin is on. Returns whether anything was cut.
  bool clip(const glm::dvec2& dir, double distance, int edge) {
    std::array<double, MOST_CORNERS + 1> beyond;
    bool cut = false;
    for (std::size_t i = 0; i < size_; ++i) {
      beyond[i] = glm::dot(corners_[i].place, dir) - distance;
      cut = cut || beyond[i] > 0.0;
    }
    if (!cut) return false;
    beyond[size_] = beyond[0];
    std::size_t count = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const double a = beyond[i], b = beyond[i + 1];
      const CellCorner& here = corners_[i];
      if (a <= 0.0) spare_[count++] = here;
      if ((a <= 0.0) == (b <= 0.0)) continue;
      const CellCorner& next = corners_[i + 1 < size_ ? i + 1 : 0];
      const glm::dvec2 crossing = here.place + (next.place - here.place) * (a / (a - b));
      spare_[count++] =
          a <= 0.0 ? CellCorner{crossing, edge, dir} : CellCorner{crossing, here.edge, here.normal};
    }
    if (count == 0)
      return false;  // rounding, as the origin is in every cell: lines that hardly miss it leave slivers
    std::swap(corners_, spare_);
    size_ = count;
    return true;
  }

 private:
  static constexpr std::size_t MOST_CORNERS = OCTAGON + MAX_CUTS + 1;
  std::array<CellCorner, MOST_CORNERS> stores_[2];
  std::span<CellCorner, MOST_CORNERS> corners_, spare_;
  std::size_t size_;
};

/// The cell's edges, in order around the origin.
struct CellEdges {
  double distance_sum = 0.0;  ///< of the neighbours that bound the cell
  std::size_t neighbours = 0;
  bool open = false;  ///< the octagon bounds it
  bool gap = false;   ///< the bounding neighbours and creases leave a wide gap
};

CellEdges examine(const Cell& cell, std::span<const TangentNeighbour> neighbours, bool ends_known) {
  CellEdges edges;
  const std::span<const CellCorner> corners = cell.corners();
  glm::dvec2 previous = corners.back().normal;
  for (const CellCorner& corner : corners) {
    edges.open = edges.open || corner.edge == OCTAGON_EDGE;
    edges.gap = edges.gap || (!ends_known && glm::dot(previous, corner.normal) < GAP_COSINE);
    previous = corner.normal;
    if (corner.edge < 0) continue;
    edges.distance_sum += neighbours[static_cast<std::size_t>(corner.edge)].distance;
    ++edges.neighbours;
  }
  edges.gap = edges.gap || edges.open;
  return edges;
}

/// Distance of the farthest corner that the octagon has no part in.
double closed_reach(const Cell& cell) {
  double squared = 0.0;
  int previous_edge = cell.corners().back().edge;
  for (const CellCorner& corner : cell.corners()) {
    if (corner.edge != OCTAGON_EDGE && previous_edge != OCTAGON_EDGE)
      squared = std::max(squared, glm::dot(corner.place, corner.place));
    previous_edge = corner.edge;
  }
  return std::sqrt(squared);
}

}  // namespace

VoronoiReach voronoi_reach(std::span<const TangentNeighbour> neighbours,
                           std::span<const TangentCrease> creases, bool ends_known) {
  assert(neighbours.size() + creases.size() <= MAX_CUTS);
  if (neighbours.empty()) return {0.0, 0.0};
  const auto ring_distance = [&](std::size_t ring) {
    return neighbours[std::min(ring, neighbours.size()) - 1].distance;
  };
  Cell cell(OCTAGON_APOTHEM * ring_distance(EVEN_RING));
  for (const TangentCrease& crease : creases) cell.clip(crease.dir, crease.distance, CREASE_EDGE);
  double decisive = 2.0 * cell.reach();
  for (std::size_t j = 0; j < neighbours.size() && neighbours[j].distance < decisive; ++j) {
    const TangentNeighbour& neighbour = neighbours[j];
    if (cell.clip(neighbour.place / neighbour.distance, 0.5 * neighbour.distance, static_cast<int>(j)))
      decisive = 2.0 * cell.reach();
  }
  const CellEdges edges = examine(cell, neighbours, ends_known);
  double radius = closed_reach(cell);
  if (edges.open && edges.neighbours > 0)
    radius = std::max(radius, OPEN_REACH * edges.distance_sum / static_cast<double>(edges.neighbours));
  if (edges.gap) radius = std::min(radius, BORDER_REACH * ring_distance(BORDER_RING));
  return {radius, decisive, edges.gap};
}

}  // namespace splatray
