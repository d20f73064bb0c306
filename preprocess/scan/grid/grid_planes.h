/// Planes through the surroundings of a grid's cells.
#pragma once
#include <cstdint>
#include <vector>

#include "preprocess/base/parallel.h"
#include "preprocess/scan/grid/depth_grid.h"

namespace splatray {

/// Gives all cells a slope: that of the neighbours on both sides or, where clearly more of the cells around lie on its plane, of
/// one side along columns and rows. Returns for each cell the weight of those that lie there, of about 33; 0 of empty ones.
[[nodiscard]] std::vector<float> find_first_slopes(DepthGrid& grid, const DepthUnit& unit,
                                                   const Stage& stage);

/// Refines slopes and inverse depths by weighted planes through 9 x 9 cells at strides of 1, 2 and 3, near ones and
/// those that are few units off by the slopes of both, so that nothing is taken across an edge; values take the bend of the
/// surface from the slopes around.
void fit_planes(DepthGrid& grid, const DepthUnit& unit, const Stage& stage);

}  // namespace splatray
