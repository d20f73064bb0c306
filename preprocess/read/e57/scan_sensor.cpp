#include "preprocess/read/e57/scan_sensor.h"

namespace splatray {
namespace {

constexpr double MOST_DIAGONALS = 20.0;
constexpr double TURNED = 1e-9;  ///< sine of half the angle

}  // namespace

bool is_sensor_at_origin(const E57Scan& scan, bool is_measured_around, const ScanBox& box) {
  if (!glm::all(glm::lessThanEqual(box.low, box.high))) return false;
  const glm::dvec3 nearest = glm::clamp(glm::dvec3(0.0), box.low, box.high);
  const double distance = glm::length(nearest);
  const bool is_shifted = scan.translation != glm::dvec3(0.0);
  const glm::dvec3 axis(scan.rotation.x, scan.rotation.y, scan.rotation.z);
  const bool is_turned = glm::length(axis) > TURNED;
  const double diagonal = glm::distance(box.low, box.high);
  const bool shows_place = is_shifted && distance <= (scan.is_shifted_alone ? diagonal : 0.0);
  if (!is_measured_around && !is_turned && !shows_place) return false;
  return distance <= MOST_DIAGONALS * diagonal;
}

}  // namespace splatray
