/// Where a scan was made from.
#pragma once
#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

namespace splatray {

/// A place that a scanner stood at, or one flight, with the form of what it measured.
struct Station {
  std::string name;
  std::optional<glm::dvec3> sensor_world;  ///< where the scanner was, as far as the file says it credibly
  std::uint32_t rows = 0;                  ///< of its grid; 0 = not structured
  std::uint32_t columns = 0;
  /// How far its points lie off their surface, standard deviation, as they were measured: before any smoothing, and at least what
  /// explains how far smoothing moved them; 0 = unknown.
  double noise_world = 0.0;
  double step_world = 0.0;  ///< what its coordinates are multiples of, along the coarsest axis; 0 = unknown
  std::optional<glm::dvec3> sensor_found_world{};  ///< where the points show that the scanner was, where no file says it
};

/// Where the scanner was, by its file or else by its points.
[[nodiscard]] inline std::optional<glm::dvec3> sensor_place_world(const Station& station) {
  return station.sensor_world ? station.sensor_world : station.sensor_found_world;
}

/// The largest noise of several; 0 = unknown.
[[nodiscard]] inline double most_noise_world(const std::vector<Station>& stations) {
  double most = 0.0;
  for (const Station& station : stations) most = std::max(most, station.noise_world);
  return most;
}

}  // namespace splatray
