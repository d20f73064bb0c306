/// Vectors as JSON.
#pragma once
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

namespace splatray {

[[nodiscard]] inline nlohmann::ordered_json json_vector(const glm::dvec3& v) {
  return nlohmann::ordered_json::array({v.x, v.y, v.z});
}

}  // namespace splatray
