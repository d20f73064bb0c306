/// Noisy points, moved onto the surface that they and their neighbours are of.
#pragma once
#include <cstdint>
#include <vector>

#include "preprocess/base/parallel.h"
#include "preprocess/scan/survey.h"
#include "preprocess/surface/cloud.h"

namespace splatray {

/// What is moved, and by what.
struct SmoothParams {
  double radius = 0.0;                   ///< of what is looked at, cloud coordinates; 0 = by the spacing
  bool sided = false;                    ///< whether normals' sides are known
  double noise = 0.0;                    ///< measure_noise
  double noise_length = 0.0;             ///< PairHeights::near_length
  std::vector<std::uint8_t> moves = {};  ///< of each point: != 0 where it may be moved; MOVES_WHERE_FLAT
  std::vector<float> sheet_end = {};     ///< part_layers; empty = there is one sheet everywhere
};

/// A value of SmoothParams::moves: a point that stays as it is unless the places around it lie on their plane but for noise.
constexpr std::uint8_t MOVES_WHERE_FLAT = 2;

/// What smoothing did.
struct Smoothed {
  std::uint64_t moved = 0;
  std::uint64_t dropped = 0;        ///< had fewer than 6 neighbours on their surface
  double moved_median_world = 0.0;  ///< how far the points moved
  bool layered = false;             ///< most of them moved about as far: they lay in two layers
};

/// Projects points and their normals once onto the plane of their surroundings, by moving least squares (Levin 2003; Alexa et
/// al. 2003, "Computing and rendering point set surfaces", with the mean normal for the plane's as Adamson and Alexa 2004): the
/// places within `radius` (cloud coordinates), every 4th, 16th and so on where more than about 64 are expected; with 0 those
/// within 2.5 times the distance to the 8th place, the point's own or the median of all, whichever is more, or, where that is
/// less, within what about 64 are expected in; weights (1 - d^2/R^2)^2 times the cosine to the point's own normal, so that
/// surfaces behind and edges stay; the plane of weighted mean and mean normal, twice weighted anew by the distance to it.
/// Places on another sheet (SmoothParams::sheet_end) are not looked at. Points with fewer than 6 such neighbours are dropped. What
/// is left is looked at again (reproject_points). Normals must be known. The cloud is in order afterwards. `survey` is freed midway,
/// when its points are gone.
[[nodiscard]] Smoothed smooth_points(Cloud& cloud, Survey survey, const SmoothParams& params,
                                     const Stage& stage);

}  // namespace splatray
