#include "engine/scene/environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace splatray {
namespace {

using std::numbers::pi;

glm::dvec3 direction_at(double column_fraction, double row_fraction) {
  const double theta = pi * row_fraction;
  const double phi = 2.0 * pi * (column_fraction - 0.5);
  return {std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)};
}

/// The polynomials of the 9 real spherical harmonics up to l = 2, in the order of environment.h.
std::array<double, 9> harmonic_polynomials(const glm::dvec3& d) {
  return {1.0, d.y, d.z, d.x, d.x * d.y, d.y * d.z, 3.0 * d.z * d.z - 1.0, d.x * d.z, d.x * d.x - d.y * d.y};
}

/// c_i = (A_l / pi) K_i^2 * integral(L P_i): K_i normalises Y_i = K_i P_i, A_l = pi, 2 pi / 3, pi / 4 is the
/// clamped cosine (Ramamoorthi and Hanrahan 2001, eq. 8).
constexpr double BAND_0 = 1.0 / (4.0 * pi);
constexpr double BAND_1 = 2.0 / 3.0 * 3.0 / (4.0 * pi);
constexpr double BAND_2 = 1.0 / 4.0 * 15.0 / (4.0 * pi);
constexpr std::array<double, 9> FOLDED_CONSTANTS = {BAND_0, BAND_1,        BAND_1, BAND_1,      BAND_2,
                                                    BAND_2, BAND_2 / 12.0, BAND_2, BAND_2 / 4.0};

/// Smooth 0..1 window of half width `half` around 0, its edge blurred over `blur`.
double soft_window(double x, double half, double blur) {
  const double s = std::clamp((half + blur - std::abs(x)) / (2.0 * blur), 0.0, 1.0);
  return s * s * (3.0 - 2.0 * s);
}

/// A rectangular lamp seen towards `axis`, its edges level with the horizon; half sizes are tangents of
/// angles.
double softbox(const glm::dvec3& dir, const glm::dvec3& axis, double half_width, double half_height) {
  const double along = glm::dot(dir, axis);
  if (along <= 0.0) return 0.0;
  const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), axis));
  const glm::dvec3 top = glm::cross(axis, right);
  constexpr double BLUR = 0.08;
  return soft_window(glm::dot(dir, right) / along, half_width, BLUR) *
         soft_window(glm::dot(dir, top) / along, half_height, BLUR);
}

glm::dvec3 studio_radiance(const glm::dvec3& dir) {
  const glm::dvec3 floor(0.13, 0.125, 0.12), horizon(0.2, 0.205, 0.215), zenith(0.27, 0.28, 0.3);
  const double above = glm::smoothstep(-0.55, 0.12, dir.y);
  const double high = glm::smoothstep(0.0, 1.0, dir.y);
  glm::dvec3 radiance = glm::mix(glm::mix(floor, horizon, above), zenith, high);
  const double glow = std::exp(-6.0 * (1.0 - glm::dot(dir, glm::normalize(glm::dvec3(0.15, 0.1, -1.0)))));
  radiance += 0.22 * glow * glm::dvec3(1.0, 1.0, 1.0);
  const double key = softbox(dir, glm::normalize(glm::dvec3(-0.75, 0.8, 0.55)), 0.3, 0.22);
  const double fill = softbox(dir, glm::normalize(glm::dvec3(0.95, 0.25, 0.3)), 0.14, 0.45);
  radiance += key * glm::dvec3(3.8, 3.7, 3.5) + fill * glm::dvec3(1.1, 1.2, 1.35);
  return radiance;
}

}  // namespace

glm::vec3 environment_direction(double column_fraction, double row_fraction) {
  return glm::vec3(direction_at(column_fraction, row_fraction));
}

std::array<glm::vec3, 9> irradiance_coefficients(const Environment& environment) {
  std::array<glm::vec3, 9> coefficients{};
  coefficients[0] = environment.constant;
  if (environment.texels.empty()) return coefficients;

  std::array<glm::dvec3, 9> sums{};
  const double width = environment.width, height = environment.height;
  for (std::uint32_t row = 0; row < environment.height; ++row) {
    const double solid_angle =
        2.0 * pi / width * (std::cos(pi * row / height) - std::cos(pi * (row + 1.0) / height));
    for (std::uint32_t column = 0; column < environment.width; ++column) {
      const auto polynomials =
          harmonic_polynomials(direction_at((column + 0.5) / width, (row + 0.5) / height));
      const glm::dvec3 radiance(environment.texels[std::size_t(row) * environment.width + column]);
      for (std::size_t i = 0; i < 9; ++i) sums[i] += radiance * (solid_angle * polynomials[i]);
    }
  }
  for (std::size_t i = 0; i < 9; ++i) coefficients[i] = glm::vec3(sums[i] * FOLDED_CONSTANTS[i]);
  return coefficients;
}

Environment studio_environment() {
  Environment studio{128, 64, {}, glm::vec3(0.0F)};
  studio.texels.reserve(std::size_t(studio.width) * studio.height);
  for (std::uint32_t row = 0; row < studio.height; ++row)
    for (std::uint32_t column = 0; column < studio.width; ++column)
      studio.texels.emplace_back(
          studio_radiance(direction_at((column + 0.5) / studio.width, (row + 0.5) / studio.height)));
  return studio;
}

}  // namespace splatray
