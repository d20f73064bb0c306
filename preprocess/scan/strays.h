/// Points that are on no surface.
#pragma once
#include <cstdint>
#include <vector>

#include "preprocess/scan/grid/grid_surface.h"
#include "preprocess/scan/survey.h"
#include "preprocess/surface/cloud.h"

namespace splatray {

/// Why a point is not drawn.
enum class Stray : std::uint8_t {
  no,
  isolated,  ///< far from its neighbours, or one of a few that are far from all others
  mixed      ///< between two surfaces that one beam met
};

/// Finds a scan's strays. Isolated: a point three times as far from its 8th neighbour as the least of its neighbours are from
/// theirs; parts of fewer than 16 points or 1/10 000 of all, and parts of less than 1/100
/// that are mostly four times as sparse as is usual; and where the sensor is known, a point whose 8th neighbour is
/// farther than 4 times what the scanner's angular step, which is measured, makes of its range. Mixed: where the station has a
/// grid too, a point that lies on none of the straight lines through the next two in the grid's 8 directions, or on one only
/// and its plane is seen at less than 15 degrees. A cloud of fewer than 1000 points has none, as they are too few; nor
/// have points whose surface their grid has determined, as their own are left out already.
[[nodiscard]] std::vector<Stray> find_strays(const Cloud& cloud, const Survey& survey,
                                             const GridSurface& grids);

}  // namespace splatray
