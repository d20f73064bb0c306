/// The Voronoi cell of one point among its neighbours in the plane.
#pragma once
#include <glm/glm.hpp>
#include <span>

namespace splatray {

/// A neighbour's place in the plane of the point it surrounds.
struct TangentNeighbour {
  glm::dvec2 place;  ///< relative to the point
  double distance;   ///< length of `place`, > 0
};

/// How far the cell of the origin reaches.
struct VoronoiReach {
  double radius;             ///< distance of the cell's farthest point; 0 without neighbours
  double decisive_distance;  ///< neighbours beyond this distance would not change the cell
};

/// The reach of the origin's Voronoi cell among `neighbours`, which ascend by distance, at most 64. The cell
/// is cut out of a regular octagon with an apothem of 2 x the distance to the 6th neighbour. Where the
/// octagon still bounds it, at the border of a surface, the cell is taken to end at 0.65 x the mean distance
/// of the neighbours that bound it.
[[nodiscard]] VoronoiReach voronoi_reach(std::span<const TangentNeighbour> neighbours);

}  // namespace splatray
