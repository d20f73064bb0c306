/// Where a scan was made from.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>

namespace splatray {

/// A place that a scanner stood at, or one flight, with the form of what it measured.
struct Station {
  std::string name;
  std::optional<glm::dvec3> sensor_world;  ///< where the scanner was, as far as the file says it credibly
  std::uint32_t rows = 0;                  ///< of its grid; 0 = not structured
  std::uint32_t columns = 0;
};

}  // namespace splatray
