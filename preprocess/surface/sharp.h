/// Creases and borders of a surface that is known by its points alone.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "preprocess/base/parallel.h"
#include "preprocess/surface/cloud.h"
#include "preprocess/surface/near_places.h"

namespace splatray {

/// A plane on which a point lies, and where the surface in it ends.
struct SharpSide {
  std::uint32_t point;
  std::uint32_t number;  ///< of the point's sides, which follow each other, from 0 on
  bool crease;           ///< ends at creases, else at borders
  glm::vec3 normal;      ///< unit, on the side of the point's
  PointClip clip;        ///< cloud coordinates
};

/// What find_sharp found, by point, and how many points' surroundings it tried planes and gaps in.
struct SharpSides {
  std::vector<SharpSide> sides;
  std::size_t looked_at = 0;
};

/// Where the evidence is clear, what a mesh would say of the points' planes and lines. Creases: the neighbourhood is two or three planes to within a twentieth of the spacing, each has points of
/// its own, on one side of the line that two share, and they turn by more than `crease_degrees` there. A point has a side for
/// each plane that it is on. A point whose normal came from the file (`estimated`, one for each point, is 0) keeps only the
/// side that agrees with it. Borders: half of a point's surroundings, or three quarters at a corner, has no neighbours, those
/// at the ends of the gap lie on its line, and far more room behind it is empty: where sampling is denser on one side nothing
/// ends. Of points around
/// which normals differ or there is a gap every other one is looked at, and whatever is beside those where something was found.
[[nodiscard]] SharpSides find_sharp(const Cloud& cloud, const NearPlaces& near, double crease_degrees,
                                    std::span<const std::uint8_t> estimated, const Stage& stage);

/// Gives points the normals of their first sides; the cloud is then out of order.
void take_normals(Cloud& cloud, std::span<const SharpSide> sides);

/// Gives points their first sides' clip lines, adds a point for each further side, and puts the cloud in order.
void take_sides(Cloud& cloud, std::span<const SharpSide> sides);

}  // namespace splatray
