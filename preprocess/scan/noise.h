/// How far points lie off their surface.
#pragma once
#include <cstdint>
#include <vector>

#include "preprocess/scan/survey.h"
#include "preprocess/surface/cloud.h"

namespace splatray {

/// What near pairs of points disagree about. Noise does not vanish with the distance, roughness and curvature do: of pairs of a
/// point and its near places with like normals, whose heights over each other's planes are |(n_i + n_j).(p_j - p_i)| / 2, the
/// nearest eighth lies 0.3 to 0.6 of the distance to the 8th place apart.
struct PairHeights {
  double near = 0.0;   ///< median height of the nearest pairs over the distance to the 8th place; 0 = unknown
  double slope = 0.0;  ///< of log height over log distance: 0 for noise alone, 1 and more for shape
  double near_length = 0.0;  ///< `near`, or `rounded` where that is more, as a length, cloud coordinates
  double rounded = 0.0;  ///< what rounding to the survey's step leaves, over the distance to the 8th place
};

/// That of these points of surfaces: of the quarter of them that lies densest, where the noise, which is as large elsewhere,
/// shows best.
[[nodiscard]] PairHeights pair_heights(const Cloud& cloud, const Survey& survey,
                                       const std::vector<std::uint32_t>& points);

/// Whether such heights are noise. On terrain, which is measured once from above, what trees and rocks between the points are
/// like is only told from noise where heights do not grow with the distance at all.
[[nodiscard]] bool is_noise(const PairHeights& heights, bool terrain);

/// How far points of surfaces lie off these, of those whose normals were estimated: the median of how much a point and its 8
/// nearest places disagree about the height of one over the other's plane, over the distance to the 8th. Curvature cancels on
/// circles, where (n_i + n_j).(p_j - p_i) is zero. Neighbours whose normals are more than 25 degrees apart are left out. Sides
/// must be known: what faces the other way is another surface. No less than what rounding to the survey's step leaves: the step across the plane over the root of 12.
/// 0 without such points.
[[nodiscard]] double measure_noise(const Cloud& cloud, const Survey& survey);

/// The same as a length of each of the cloud's stations, world units, one where there are none: the standard deviation of
/// heights over the planes, of which two points' disagreement has the root of 2; 0 without such points.
[[nodiscard]] std::vector<double> station_noise_world(const Cloud& cloud, const Survey& survey);

/// What the coordinates of each station's points are multiples of, world units, along the axis where that is most
/// (coordinate_step).
[[nodiscard]] std::vector<double> station_step_world(const Cloud& cloud);

/// What the places' coordinates are multiples of, along each axis, in cloud coordinates: the least difference among at most 65
/// 536 of them, which is next to nothing where they were not rounded; 0 where the cloud's positions are gone.
[[nodiscard]] glm::vec3 coordinate_step(const Cloud& cloud);

}  // namespace splatray
