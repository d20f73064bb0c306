/// Whether a scanner can have stood where a file says.
#pragma once
#include <vector>

#include "preprocess/points.h"

namespace splatray {

/// The place, unless it is too far from the box of the points [first, end): for the origin further than that box is long, as
/// files whose points were moved to the world after the scan keep the origin of the scanner's own frame; for any other
/// place, which somebody has put there, further than ten times that.
[[nodiscard]] std::optional<glm::dvec3> credible_sensor(const glm::dvec3& place_world,
                                                        const std::vector<glm::dvec3>& position,
                                                        std::size_t first = 0);

}  // namespace splatray
