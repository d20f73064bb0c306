/// Where the scanner of an E57 scan stood.
#pragma once
#include <glm/glm.hpp>
#include <limits>

#include "preprocess/read/e57/description.h"

namespace splatray {

/// The box of a scan's points in its own frame, the points at its very origin left out.
struct ScanBox {
  glm::dvec3 low{std::numeric_limits<double>::infinity()};
  glm::dvec3 high{-std::numeric_limits<double>::infinity()};

  void add(const glm::dvec3& point) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
};

/// Whether the origin of a scan's frame is credible as the scanner's place, so that the pose's translation is where it stood.
/// E57 does not say so: registered clouds are stored as scans too, in world coordinates or shifted by a pose. The rule:
/// - The file must say that the points are in a frame of the scanner's own: they are spherical or in a grid (`is_measured_around`),
///   or a pose turns them. A pose that only shifts counts when the origin is within the points' box or, where another scan of the
///   file is shifted otherwise, no further from it than its diagonal: such poses are also how programs store large coordinates,
///   but then one for all.
/// - The origin must be no further from the points' box than 20 of its diagonals. (A range camera sees an object from some
///   5 of them; map coordinates are hundreds to thousands away from their origin.)
[[nodiscard]] bool is_sensor_at_origin(const E57Scan& scan, bool is_measured_around, const ScanBox& box);

}  // namespace splatray
