#include "preprocess/read/scan/sensor_place.h"

#include <cmath>

namespace splatray {

std::optional<glm::dvec3> credible_sensor(const glm::dvec3& place_world,
                                          const std::vector<glm::dvec3>& position, std::size_t first) {
  glm::dvec3 low(INFINITY);
  glm::dvec3 high(-INFINITY);
  for (std::size_t i = first; i < position.size(); ++i) {
    low = glm::min(low, position[i]);
    high = glm::max(high, position[i]);
  }
  const double away = glm::length(place_world - glm::clamp(place_world, low, high));
  const double most = glm::length(high - low) * (place_world == glm::dvec3(0.0) ? 1.0 : 10.0);
  const bool credible = first < position.size() && away <= most && std::isfinite(away);
  return credible ? std::optional(place_world) : std::nullopt;
}

}  // namespace splatray
