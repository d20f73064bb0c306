/// Stations that no point was measured from.
#pragma once
#include <string>
#include <vector>

#include "preprocess/points.h"

namespace splatray {

/// Removes the stations of several that no point is of and renumbers the others; one stays where all are such. Returns the
/// names of those removed, "number 2" where one has none.
[[nodiscard]] std::vector<std::string> remove_empty_stations(Points& points);

}  // namespace splatray
