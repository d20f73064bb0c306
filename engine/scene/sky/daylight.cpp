#include "engine/scene/sky/daylight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace splatray {
namespace {

using std::numbers::pi;

constexpr std::uint32_t WIDTH = 1024, HEIGHT = 512;
constexpr double SUN_RADIUS = 0.2666 * pi / 180.0;
constexpr double GROUND_ALBEDO = 0.2;
/// Illuminance of the sun outside the atmosphere, kilolux.
constexpr double SUN_KILOLUX = 133.3;

double luminance(const glm::dvec3& color) { return glm::dot(color, glm::dvec3(0.2126, 0.7152, 0.0722)); }

/// F of Perez: how the sky's luminance or chromaticity goes with the angle from the zenith and from the sun.
struct Perez {
  double a, b, c, d, e;

  [[nodiscard]] double operator()(double cos_zenith, double sun_angle) const {
    const double cosine = std::cos(sun_angle);
    return (1.0 + a * std::exp(b / std::max(cos_zenith, 0.01))) *
           (1.0 + c * std::exp(d * sun_angle) + e * cosine * cosine);
  }
};

/// The sky's light in CIE xyY, kilocandela per square metre.
class Sky {
 public:
  explicit Sky(const Daylight& day) : sun_zenith_(0.5 * pi - day.sun_elevation_deg * pi / 180.0) {
    const double t = day.turbidity;
    perez_ = {{{0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251, 0.1206 * t - 2.5771,
                -0.0670 * t + 0.3703},
               {-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989,
                -0.0033 * t + 0.0452},
               {-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537,
                -0.0109 * t + 0.0529}}};
    const double s = sun_zenith_, chi = (4.0 / 9.0 - t / 120.0) * (pi - 2.0 * s);
    const glm::dvec4 powers(s * s * s, s * s, s, 1.0);
    const auto chromaticity = [&](const glm::dvec4& squared, const glm::dvec4& linear,
                                  const glm::dvec4& constant) {
      return t * t * glm::dot(squared, powers) + t * glm::dot(linear, powers) + glm::dot(constant, powers);
    };
    zenith_ = {(4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192,
               chromaticity({0.00166, -0.00375, 0.00209, 0.0}, {-0.02903, 0.06377, -0.03202, 0.00394},
                            {0.11693, -0.21196, 0.06052, 0.25886}),
               chromaticity({0.00275, -0.00610, 0.00317, 0.0}, {-0.04214, 0.08970, -0.04153, 0.00516},
                            {0.15346, -0.26756, 0.06670, 0.26688})};
  }

  /// Linear sRGB.
  [[nodiscard]] glm::dvec3 radiance(double cos_zenith, double sun_angle) const {
    std::array<double, 3> value{};
    for (std::size_t i = 0; i < 3; ++i)
      value[i] = zenith_[i] * perez_[i](cos_zenith, sun_angle) / perez_[i](1.0, sun_zenith_);
    const auto [light, x, y] = value;
    const glm::dvec3 xyz(x / y * light, light, (1.0 - x - y) / y * light);
    const glm::dmat3 to_srgb({3.2404542, -0.9692660, 0.0556434}, {-1.5371385, 1.8760108, -0.2040259},
                             {-0.4985314, 0.0415560, 1.0572252});
    return glm::max(to_srgb * xyz, glm::dvec3(0.0));
  }

 private:
  double sun_zenith_;
  std::array<Perez, 3> perez_{};
  std::array<double, 3> zenith_{};
};

/// The sun's irradiance across its direction, linear sRGB, kilolux: what Rayleigh scattering, aerosol and ozone leave of it.
glm::dvec3 sun_irradiance(const Daylight& day) {
  const double zenith_deg = 90.0 - day.sun_elevation_deg;
  const double mass =
      1.0 / (std::cos(zenith_deg * pi / 180.0) + 0.15 * std::pow(93.885 - zenith_deg, -1.253));
  const double beta = 0.04608365822050 * day.turbidity - 0.04586025928522;
  constexpr std::array WAVELENGTH = {0.610, 0.550, 0.465}, OZONE = {0.122, 0.085, 0.009};
  /// Sunlight outside the atmosphere over that of D65.
  constexpr std::array SUN = {1.10, 1.0, 1.06};
  glm::dvec3 light;
  for (int i = 0; i < 3; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const double rayleigh = 0.008735 * std::pow(WAVELENGTH[at], -4.08);
    const double aerosol = beta * std::pow(WAVELENGTH[at], -1.3);
    light[i] = SUN[at] * std::exp(-mass * (rayleigh + aerosol + 0.35 * OZONE[at]));
  }
  return light * (SUN_KILOLUX / luminance({SUN[0], SUN[1], SUN[2]}));
}

/// Texels that see the sun, by the share of it in each: those that lie about its middle.
void add_sun(const glm::dvec3& to_sun, const glm::dvec3& irradiance, std::vector<glm::dvec3>& texels) {
  constexpr int STEPS = 16;
  const double row_angle = pi / HEIGHT;
  const auto first = static_cast<std::int64_t>(std::floor((std::acos(to_sun.y) - SUN_RADIUS) / row_angle));
  const auto last = static_cast<std::int64_t>(std::ceil((std::acos(to_sun.y) + SUN_RADIUS) / row_angle));
  std::vector<std::pair<std::size_t, double>> shares;
  double sum = 0.0;
  for (std::int64_t row = std::max<std::int64_t>(first, 0); row < std::min<std::int64_t>(last, HEIGHT); ++row)
    for (std::uint32_t column = 0; column < WIDTH; ++column) {
      double share = 0.0;
      for (int y = 0; y < STEPS; ++y)
        for (int x = 0; x < STEPS; ++x) {
          const double down = (double(row) + (y + 0.5) / STEPS) / HEIGHT;
          const glm::dvec3 dir(environment_direction((column + (x + 0.5) / STEPS) / WIDTH, down));
          if (glm::dot(dir, to_sun) >= std::cos(SUN_RADIUS)) share += std::sin(pi * down);
        }
      if (share > 0.0) shares.emplace_back(std::size_t(row) * WIDTH + column, share);
      sum += share;
    }
  const double texel_angle = 2.0 * pi / WIDTH * row_angle / (STEPS * STEPS);
  for (const auto& [texel, share] : shares) {
    const double row = double(texel / WIDTH) + 0.5;
    texels[texel] += irradiance * (share / sum) / (texel_angle * STEPS * STEPS * std::sin(pi * row / HEIGHT));
  }
}

/// Irradiance of a level surface from above.
glm::dvec3 level_irradiance(const std::vector<glm::dvec3>& texels) {
  glm::dvec3 sum(0.0);
  for (std::uint32_t row = 0; row < HEIGHT / 2; ++row) {
    const double theta = pi * (row + 0.5) / HEIGHT;
    const double weight = 2.0 * pi / WIDTH * (pi / HEIGHT) * std::sin(theta) * std::cos(theta);
    for (std::uint32_t column = 0; column < WIDTH; ++column)
      sum += weight * texels[std::size_t(row) * WIDTH + column];
  }
  return sum;
}

}  // namespace

Environment daylight_environment(const Daylight& daylight) {
  const Sky sky(daylight);
  const double elevation = daylight.sun_elevation_deg * pi / 180.0;
  const glm::dvec3 to_sun(
      environment_direction(0.5 + daylight.sun_azimuth_deg / 360.0, 0.5 - elevation / pi));
  std::vector<glm::dvec3> texels(std::size_t{WIDTH} * HEIGHT);
  for (std::uint32_t row = 0; row < HEIGHT / 2; ++row)
    for (std::uint32_t column = 0; column < WIDTH; ++column) {
      const glm::dvec3 dir(environment_direction((column + 0.5) / WIDTH, (row + 0.5) / HEIGHT));
      texels[std::size_t(row) * WIDTH + column] =
          sky.radiance(dir.y, std::acos(std::clamp(glm::dot(dir, to_sun), -1.0, 1.0)));
    }
  add_sun(to_sun, sun_irradiance(daylight), texels);
  const glm::dvec3 irradiance = level_irradiance(texels);
  const double factor = pi / luminance(irradiance);
  const glm::dvec3 ground = irradiance * (GROUND_ALBEDO / pi);
  std::fill(texels.begin() + std::ptrdiff_t(texels.size() / 2), texels.end(), ground);
  Environment environment{WIDTH, HEIGHT, {}, glm::vec3(0.0F)};
  environment.texels.reserve(texels.size());
  for (const glm::dvec3& texel : texels) environment.texels.emplace_back(factor * texel);
  return environment;
}

}  // namespace splatray
