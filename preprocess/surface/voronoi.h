/// The Voronoi cell of one point among its neighbours in the plane.
#pragma once
#include <cstddef>
#include <glm/glm.hpp>
#include <span>

namespace splatray {

/// The neighbours around a point of an even sampling.
inline constexpr std::size_t EVEN_RING = 6;

/// A neighbour's place in the plane of the point it surrounds.
struct TangentNeighbour {
  glm::dvec2 place;  ///< relative to the point
  double distance;   ///< length of `place`, > 0
};

/// Where the plane of the point meets that of a neighbour on another sheet: the surface bends here, and the
/// point's sheet ends. Or a line that clips the point's disc.
struct TangentCrease {
  glm::dvec2 dir;   ///< unit vector from the point towards the crease, perpendicular to it
  double distance;  ///< from the point to the crease, >= 0
};

/// How far the cell of the origin reaches.
struct VoronoiReach {
  double radius;             ///< distance of the cell's farthest point; 0 without neighbours
  double decisive_distance;  ///< neighbours beyond this distance would not change the cell
  bool open = false;  ///< no neighbour bounds it on some side: the surface ends, or is not sampled, there
};

/// The reach of the origin's Voronoi cell among `neighbours`, which ascend by distance, on its side of the
/// `creases`; each at most 64. The cell is cut out of a regular octagon with an apothem of 4 x the distance
/// to the 6th neighbour. Where the octagon still bounds it, at the border of a surface, the cell is taken to
/// end at 0.65 x the mean distance of the neighbours that bound it. Where the neighbours that bound it leave
/// a gap of more than 150 degrees, the cell is also taken to end at 0.8 x the distance to the 4th neighbour:
/// along a border two neighbours and the point are nearly in line and their cells meet far outside; elsewhere
/// such a corner belongs to an obtuse triangle that the discs of the neighbours cover. Where the surface's ends are known, as
/// creases that clip the disc, a gap is none of them, and the disc reaches as far as it must.
[[nodiscard]] VoronoiReach voronoi_reach(std::span<const TangentNeighbour> neighbours,
                                         std::span<const TangentCrease> creases, bool ends_known = false);

}  // namespace splatray
