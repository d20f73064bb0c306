/// Numbers that stand for many.
#pragma once
#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <vector>

namespace splatray::testing {

/// The value below which this share, 0..1, of the values lies (nearest rank); NaN for no values.
[[nodiscard]] inline double quantile(std::vector<double> values, double share) {
  if (values.empty()) return NAN;
  const auto last = static_cast<double>(values.size() - 1);
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::lround(share * last));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// NaN for no values.
[[nodiscard]] inline double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

[[nodiscard]] inline double root_mean_square(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

/// Angle between two unit vectors, degrees, 0..180; exact for small angles too.
[[nodiscard]] inline double angle_deg(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180.0 / std::numbers::pi;
}

}  // namespace splatray::testing
