/// Radii of discs, so that they close the surface with little overlap.
#pragma once
#include "preprocess/base/parallel.h"
#include "preprocess/surface/cloud.h"

namespace splatray {

/// The most of the distance to the 6th place that a disc of an open cell follows, in units of the median around.
inline constexpr float MOST_OVER_USUAL = 2.0F;

/// Fills every unknown (zero) radius of the cloud and multiplies all of them, given ones too, by `scale`. Rule `knn`: 0.65 x
/// the distance to the 6th nearest place. Rule `coverage`: the disc reaches the farthest point of the point's own Voronoi cell
/// (voronoi_reach), and as much more as its surroundings are rough. Rule `given`: as coverage. No computed radius exceeds 4
/// times the median of those of the 12 nearest points when it also exceeds 4 times the cloud's median: stray points stay small.
/// Of points that were measured, closed cells reach no farther than 2.2 times the distance to the 6th place, the point's own or
/// the median of the 16 nearest's, open cells no farther than 0.65 times twice that median where their own is more, and points
/// on no surface (Cloud::kind) are neighbours of none. Radii stay zero where a point has no neighbour at another place. With
/// `fields`, fills cloud.field too (fit_normal_field), as the same neighbours are looked for. The normals must be known.
void find_radii(Cloud& cloud, RadiusRule rule, double scale, bool fields, const Stage& stage);

}  // namespace splatray
