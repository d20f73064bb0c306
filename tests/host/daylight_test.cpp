#include "engine/scene/sky/daylight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace splatray {
namespace {

using std::numbers::pi;

double luminance(const glm::vec3& color) {
  return 0.2126 * double(color.x) + 0.7152 * double(color.y) + 0.0722 * double(color.z);
}

/// Luminance towards a direction, degrees above the horizon and clockwise from north, of the texel there.
double seen(const Environment& sky, double elevation_deg, double azimuth_deg) {
  const auto row = std::uint32_t((0.5 - elevation_deg / 180.0) * sky.height);
  const auto column = std::uint32_t(std::fmod(1.5 + azimuth_deg / 360.0, 1.0) * sky.width);
  return luminance(sky.texels[std::size_t(row) * sky.width + column]);
}

/// Irradiance of a level surface from the sky above, of the texels within `radius_deg` of a direction or of all others.
double level(const Environment& sky, const glm::dvec3& towards, double radius_deg, bool within) {
  double sum = 0.0;
  for (std::uint32_t row = 0; row < sky.height / 2; ++row) {
    const double theta = pi * (row + 0.5) / sky.height;
    for (std::uint32_t column = 0; column < sky.width; ++column) {
      const glm::dvec3 dir(environment_direction((column + 0.5) / sky.width, (row + 0.5) / sky.height));
      if ((glm::dot(dir, towards) > std::cos(radius_deg * pi / 180.0)) != within) continue;
      sum += luminance(sky.texels[std::size_t(row) * sky.width + column]) * std::sin(theta) *
             std::cos(theta) * 2.0 * pi / sky.width * pi / sky.height;
    }
  }
  return sum;
}

glm::dvec3 direction(const Daylight& day) {
  return glm::dvec3(
      environment_direction(0.5 + day.sun_azimuth_deg / 360.0, 0.5 - day.sun_elevation_deg / 180.0));
}

TEST(Daylight, LightsALevelSurfaceByPi) {
  for (const double elevation : {2.0, 30.0, 90.0}) {
    const Daylight day{elevation, 200.0, 3.0};
    const Environment sky = daylight_environment(day);
    EXPECT_NEAR(level(sky, direction(day), 180.0, true), pi, 1e-4 * pi) << elevation;
    for (const glm::vec3& texel : sky.texels)
      ASSERT_TRUE(std::isfinite(texel.x + texel.y + texel.z) && texel.x >= 0.0F && texel.y >= 0.0F &&
                  texel.z >= 0.0F);
  }
}

TEST(Daylight, TheSunStandsWhereItShould) {
  const Daylight day{35.0, 120.0, 3.0};
  const Environment sky = daylight_environment(day);
  std::size_t brightest = 0;
  for (std::size_t i = 0; i < sky.texels.size(); ++i)
    if (luminance(sky.texels[i]) > luminance(sky.texels[brightest])) brightest = i;
  const glm::dvec3 found(environment_direction((double(brightest % sky.width) + 0.5) / sky.width,
                                               (double(brightest / sky.width) + 0.5) / sky.height));
  EXPECT_GT(glm::dot(found, direction(day)), std::cos(0.5 * pi / 180.0));
  EXPECT_NEAR(direction(day).x, std::cos(35.0 * pi / 180.0) * std::sin(120.0 * pi / 180.0), 1e-6) << "east";
}

/// F of Perez for luminance (Preetham, Shirley and Smits 1999, appendix A.2).
double perez(double turbidity, double cos_zenith, double gamma) {
  const double t = turbidity, a = 0.1787 * t - 1.4630, b = -0.3554 * t + 0.4275, c = -0.0227 * t + 5.3251,
               d = 0.1206 * t - 2.5771, e = -0.0670 * t + 0.3703;
  return (1.0 + a * std::exp(b / cos_zenith)) *
         (1.0 + c * std::exp(d * gamma) + e * std::cos(gamma) * std::cos(gamma));
}

/// The sky's light on a level surface, kilolux, integrated anew from the model's luminance.
double sky_kilolux(const Daylight& day) {
  const double sun = pi / 2.0 - day.sun_elevation_deg * pi / 180.0, t = day.turbidity;
  const double chi = (4.0 / 9.0 - t / 120.0) * (pi - 2.0 * sun);
  const double zenith = (4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192;
  constexpr int STEPS = 400;
  double sum = 0.0;
  for (int i = 0; i < STEPS; ++i)
    for (int j = 0; j < STEPS; ++j) {
      const double theta = (i + 0.5) / STEPS * pi / 2.0, phi = (j + 0.5) / STEPS * 2.0 * pi;
      const double gamma =
          std::acos(std::cos(theta) * std::cos(sun) + std::sin(theta) * std::sin(sun) * std::cos(phi));
      sum += perez(t, std::cos(theta), gamma) * std::sin(theta) * std::cos(theta);
    }
  return zenith * sum / perez(t, 1.0, sun) * (pi / 2.0 / STEPS) * (2.0 * pi / STEPS);
}

/// The sun's share of the light, of its light outside the atmosphere and what 550 nm leaves of that, where the eye is most sensitive.
TEST(Daylight, SunAndSkyShareTheLightAsTheModelSays) {
  for (const Daylight& day :
       {Daylight{60.0, 180.0, 2.5}, Daylight{60.0, 180.0, 6.0}, Daylight{20.0, 180.0, 2.5}}) {
    const double zenith_deg = 90.0 - day.sun_elevation_deg;
    const double mass =
        1.0 / (std::cos(zenith_deg * pi / 180.0) + 0.15 * std::pow(93.885 - zenith_deg, -1.253));
    const double beta = 0.04608 * day.turbidity - 0.04586;
    const double passes =
        std::exp(-mass * (0.008735 * std::pow(0.55, -4.08) + beta * std::pow(0.55, -1.3) + 0.35 * 0.085));
    const double sun = 133.3 * passes * std::sin(day.sun_elevation_deg * pi / 180.0), sky = sky_kilolux(day);
    EXPECT_NEAR(level(daylight_environment(day), direction(day), 0.8, true) / pi, sun / (sun + sky), 0.02)
        << day.sun_elevation_deg << " " << day.turbidity;
  }
}

/// Ratios of the sky's luminance that Preetham, Shirley and Smits 1999 give by F of Perez, worked out by hand for turbidity 3 and the
/// sun in the zenith's meridian 45 degrees up.
TEST(Daylight, TheSkyFollowsPerez) {
  const Environment sky = daylight_environment({45.0, 180.0, 3.0});
  const auto seen_by = [](double zenith_deg, double sun_deg) {
    return perez(3.0, std::cos(zenith_deg * pi / 180.0), sun_deg * pi / 180.0);
  };
  // Texels' middles lie up to a quarter of a degree from these directions.
  EXPECT_NEAR(seen(sky, 45.0, 0.0) / seen(sky, 89.9, 0.0), seen_by(45.0, 90.0) / seen_by(0.0, 45.0), 0.02);
  EXPECT_NEAR(seen(sky, 20.0, 0.0) / seen(sky, 89.9, 0.0), seen_by(70.0, 115.0) / seen_by(0.0, 45.0), 0.02);
  EXPECT_NEAR(seen(sky, 70.0, 180.0) / seen(sky, 89.9, 0.0), seen_by(20.0, 25.0) / seen_by(0.0, 45.0), 0.05);
}

}  // namespace
}  // namespace splatray
