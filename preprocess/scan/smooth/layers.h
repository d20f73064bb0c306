/// Two sheets of surface behind each other: both sides of a wall.
#pragma once
#include <vector>

#include "preprocess/scan/survey.h"
#include "preprocess/surface/cloud.h"

namespace splatray {

/// How far along its normal each of these points' own sheet ends and another begins, cloud coordinates; infinite where there is
/// none. The heights of what is around a point, with like axes, have two peaks then: their means are more than 4.5 of their common
/// deviation apart (Ashman et al. 1994, "Detecting bimodality in astronomical datasets"; 2.7 for one normal distribution, 3.5 for
/// one that is even, as of a bent sheet), and the other sheet lies behind all of this one, not beside it as below a step. Where
/// `sides_known`, if only by votes, sheets on the same side are two from 8 deviations on: nearer ones are scans of one surface. Where
/// they are not, each normal is turned away from the other sheet: no scanner sees into a slit between them. Empty where hardly any
/// of every 32nd point has two.
[[nodiscard]] std::vector<float> part_layers(Cloud& cloud, const Survey& survey,
                                             const std::vector<std::uint32_t>& points, bool sides_known,
                                             const Stage& stage);

/// Whether a place at this height over a point's plane is on the point's own sheet; `end` of all points, empty = all are.
[[nodiscard]] inline bool is_same_sheet(const std::vector<float>& end, std::size_t point, float height) {
  return end.empty() || (end[point] > 0.0F ? height < end[point] : height > end[point]);
}

}  // namespace splatray
