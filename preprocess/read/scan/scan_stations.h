/// Stations by numbers.
#pragma once
#include <vector>

#include "preprocess/points.h"

namespace splatray {

/// A station of each of these numbers, ascending, named by it; `numbers` are the points'. False, with nothing done, where
/// they are not whole or more than 65535.
[[nodiscard]] bool make_stations(const std::vector<double>& numbers, Points& points);

}  // namespace splatray
