#include "engine/scene/sky/daylight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/scene/sky/hosek_wilkie.h"

namespace splatray {
namespace {

using std::numbers::pi;

constexpr std::uint32_t WIDTH = 1024, HEIGHT = 512;
constexpr double SUN_RADIUS = 0.2666 * pi / 180.0;
constexpr double GROUND_ALBEDO = 0.2;
/// A unit of the model's XYZ, which is 683 lm, in W.
constexpr double WATTS = 683.0 / DAYLIGHT_LUMENS_PER_WATT;

double to_radians(double degrees) { return degrees * pi / 180.0; }

glm::dvec3 srgb_of(const glm::dvec3& xyz) {
  const glm::dmat3 to_srgb({3.2404542, -0.9692660, 0.0556434}, {-1.5371385, 1.8760108, -0.2040259},
                           {-0.4985314, 0.0415560, 1.0572252});
  return glm::max(to_srgb * xyz, glm::dvec3(0.0));
}

/// Where a number lies between two of 0 .. count - 1: the lower, and how far from it.
struct Between {
  std::size_t low;
  double share;
};
Between between(double at, std::size_t count) {
  const double low = std::clamp(std::floor(at), 0.0, double(count - 2));
  return {static_cast<std::size_t>(low), std::clamp(at - low, 0.0, 1.0)};
}

Between turbidity_between(const Daylight& day) {
  return between(day.turbidity - 2.0, hosek_wilkie::TURBIDITIES);
}

/// The tables' parameter of the sun's elevation: even steps are finer near the horizon.
double elevation_root(const Daylight& day) { return std::cbrt(day.sun_elevation_deg / 90.0); }

/// The sky's radiance in CIE XYZ: eq. 8 of Hosek and Wilkie 2012, whose parameters follow a Bezier curve of degree 5 over the cube root
/// of the sun's elevation and a straight line between whole turbidities.
class Sky {
 public:
  explicit Sky(const Daylight& day) {
    using namespace hosek_wilkie;
    const double t = elevation_root(day);
    constexpr std::array<double, CONTROLS> BINOMIAL = {1.0, 5.0, 10.0, 10.0, 5.0, 1.0};
    const auto [low, share] = turbidity_between(day);
    for (std::size_t channel = 0; channel < CHANNELS; ++channel)
      for (const std::size_t step : {std::size_t{0}, std::size_t{1}})
        for (std::size_t control = 0; control < CONTROLS; ++control) {
          const double weight = (step == 0 ? 1.0 - share : share) * BINOMIAL[control] *
                                std::pow(1.0 - t, double(CONTROLS - 1 - control)) *
                                std::pow(t, double(control));
          const std::size_t at = (channel * TURBIDITIES + low + step) * CONTROLS + control;
          mean_[channel] += weight * double(SKY_RADIANCE[at]);
          for (std::size_t i = 0; i < PARAMETERS; ++i)
            parameters_[channel][i] += weight * double(SKY_PARAMETERS[at * PARAMETERS + i]);
        }
  }

  /// Linear sRGB, W/m2/sr; above the horizon.
  [[nodiscard]] glm::dvec3 radiance(double cos_zenith, double sun_angle) const {
    const double cosine = std::cos(sun_angle);
    glm::dvec3 xyz;
    for (int channel = 0; channel < 3; ++channel) {
      const auto& [a, b, c, d, e, f, g, i, h] = parameters_[static_cast<std::size_t>(channel)];
      const double glow = (1.0 + cosine * cosine) / std::pow(1.0 + h * h - 2.0 * h * cosine, 1.5);
      xyz[channel] = mean_[static_cast<std::size_t>(channel)] *
                     (1.0 + a * std::exp(b / (cos_zenith + 0.01))) *
                     (c + d * std::exp(e * sun_angle) + f * cosine * cosine + g * glow +
                      i * std::sqrt(std::max(cos_zenith, 0.0)));
    }
    return WATTS * srgb_of(xyz);
  }

 private:
  std::array<std::array<double, hosek_wilkie::PARAMETERS>, 3> parameters_{};
  std::array<double, 3> mean_{};
};

/// The sun's irradiance across its direction, linear sRGB, W/m2.
glm::dvec3 sun_irradiance(const Daylight& day) {
  using namespace hosek_wilkie;
  constexpr double TOP = 700.0;
  // Kasten and Young 1989, "Revised Optical Air Mass Tables and Approximation Formula".
  const double mass = 1.0 / (std::sin(to_radians(day.sun_elevation_deg)) +
                             0.50572 * std::pow(day.sun_elevation_deg + 6.07995, -1.6364));
  const auto [low, share] = turbidity_between(day);
  const auto [node, on] = between(elevation_root(day) * double(SUN_NODES - 1), SUN_NODES);
  glm::dvec3 xyz;
  for (std::size_t channel = 0; channel < CHANNELS; ++channel) {
    const auto light = [channel, mass, node = node, on = on](std::size_t turbidity) {
      const std::size_t at = (channel * TURBIDITIES + turbidity) * SUN_NODES + node;
      return TOP * std::exp(-mass * std::lerp(double(SUN_DEPTH[at]), double(SUN_DEPTH[at + 1]), on));
    };
    xyz[static_cast<int>(channel)] = std::lerp(light(low), light(low + 1), share);
  }
  return srgb_of(xyz);
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
  const double elevation = to_radians(daylight.sun_elevation_deg);
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
  const glm::dvec3 ground = level_irradiance(texels) * (GROUND_ALBEDO / pi);
  std::fill(texels.begin() + std::ptrdiff_t(texels.size() / 2), texels.end(), ground);
  Environment environment{WIDTH, HEIGHT, {}, glm::vec3(0.0F)};
  environment.texels.reserve(texels.size());
  for (const glm::dvec3& texel : texels) environment.texels.emplace_back(texel);
  return environment;
}

}  // namespace splatray
