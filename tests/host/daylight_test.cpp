#include "engine/scene/sky/daylight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/scene/sky/sun_position.h"

namespace splatray {
namespace {

using std::numbers::pi;

double luminance(const glm::dvec3& color) { return glm::dot(color, glm::dvec3(0.2126, 0.7152, 0.0722)); }

/// Irradiance of a level surface from the sky above, of the texels within `radius_deg` of a direction or of all others.
glm::dvec3 level(const Environment& sky, const glm::dvec3& towards, double radius_deg, bool within) {
  glm::dvec3 sum(0.0);
  for (std::uint32_t row = 0; row < sky.height / 2; ++row) {
    const double theta = pi * (row + 0.5) / sky.height;
    for (std::uint32_t column = 0; column < sky.width; ++column) {
      const glm::dvec3 dir(environment_direction((column + 0.5) / sky.width, (row + 0.5) / sky.height));
      if ((glm::dot(dir, towards) > std::cos(radius_deg * pi / 180.0)) != within) continue;
      sum += glm::dvec3(sky.texels[std::size_t(row) * sky.width + column]) *
             (std::sin(theta) * std::cos(theta) * 2.0 * pi / sky.width * pi / sky.height);
    }
  }
  return sum;
}

glm::dvec3 direction(const Daylight& day) {
  return glm::dvec3(
      environment_direction(0.5 + day.sun_azimuth_deg / 360.0, 0.5 - day.sun_elevation_deg / 180.0));
}

/// What is left where the sun is hidden, and what there is: of a level floor. Mitsuba 3.9.1's sunsky, which has the tables of Hosek and
/// Wilkie too, of turbidity 3. Preetham's sky made 0.80, 0.40 and 0.24 of it, bluish at 10 degrees.
TEST(Daylight, ShadowsAreAsDarkAndLightAsWarmAsHosekAndWilkieSay) {
  for (const auto& [elevation, expected] :
       {std::pair(10.0, 0.52), std::pair(30.0, 0.26), std::pair(60.0, 0.16)}) {
    const Daylight day{elevation, 200.0, 3.0};
    const Environment sky = daylight_environment(day);
    const glm::dvec3 shadow = level(sky, direction(day), 1.0, false),
                     sun = level(sky, direction(day), 1.0, true);
    EXPECT_NEAR(luminance(shadow) / luminance(shadow + sun), expected, 0.1 * expected) << elevation;
  }
  const Daylight evening{10.0, 200.0, 3.0};
  const glm::dvec3 light = level(daylight_environment(evening), direction(evening), 180.0, true);
  const glm::dvec3 color = light / luminance(light), expected(1.11, 0.98, 0.85);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(color[i], expected[i], 0.1 * expected[i]);
}

/// The reference implementation of the model's spectra, version 1.4a, of the sky without the disc, and of the disc's irradiance scaled
/// to a radius of 0.2666 degrees, both integrated with CIE's functions of 1931: horizontal, klx.
TEST(Daylight, IsAsBrightAsTheModel) {
  struct Row {
    double elevation, turbidity, sky, sun;
  };
  for (const Row& row : {Row{10, 3, 8.83, 7.79}, Row{30, 3, 13.52, 38.23}, Row{60, 3, 14.91, 75.38},
                         Row{5, 2, 5.97, 2.44}, Row{45, 6.5, 26.18, 51.69}, Row{60, 10, 64.66, 46.31}}) {
    const Daylight day{row.elevation, 120.0, row.turbidity};
    const Environment sky = daylight_environment(day);
    const double klx = DAYLIGHT_LUMENS_PER_WATT / 1000.0;
    EXPECT_NEAR(luminance(level(sky, direction(day), 1.0, false)) * klx, row.sky, 0.04 * row.sky)
        << row.elevation;
    EXPECT_NEAR(luminance(level(sky, direction(day), 1.0, true)) * klx, row.sun, 0.04 * row.sun)
        << row.elevation;
  }
}

TEST(Daylight, EveryTexelIsLight) {
  for (const double elevation : {0.1, 2.0, 30.0, 90.0})
    for (const double turbidity : {2.0, 5.5, 10.0})
      for (const glm::vec3& texel : daylight_environment({elevation, 200.0, turbidity}).texels)
        ASSERT_TRUE(std::isfinite(texel.x + texel.y + texel.z) && texel.x >= 0.0F && texel.y >= 0.0F &&
                    texel.z >= 0.0F)
            << elevation << " " << turbidity;
}

TEST(Daylight, TheSunStandsWhereItShould) {
  const Daylight day{35.0, 120.0, 3.0};
  const Environment sky = daylight_environment(day);
  std::size_t brightest = 0;
  for (std::size_t i = 0; i < sky.texels.size(); ++i)
    if (luminance(glm::dvec3(sky.texels[i])) > luminance(glm::dvec3(sky.texels[brightest]))) brightest = i;
  const glm::dvec3 found(environment_direction((double(brightest % sky.width) + 0.5) / sky.width,
                                               (double(brightest / sky.width) + 0.5) / sky.height));
  EXPECT_GT(glm::dot(found, direction(day)), std::cos(0.5 * pi / 180.0));
  EXPECT_NEAR(direction(day).x, std::cos(35.0 * pi / 180.0) * std::sin(120.0 * pi / 180.0), 1e-6) << "east";
}

/// Reda and Andreas 2004, "Solar Position Algorithm for Solar Radiation Applications", table A5.1, whose observer stands 1830 m high;
/// Meeus 1998, example 25.a, whose declination is that of the sun in the zenith of a place with that latitude at noon.
TEST(SunPosition, IsThatOfEphemerides) {
  const SunPosition golden =
      sun_position(julian_day(2003, 10, 17, 19.0 + 30.0 / 60.0 + 30.0 / 3600.0), 39.742476, -105.1786);
  EXPECT_NEAR(golden.elevation_deg, 90.0 - 50.11162, 0.05);
  EXPECT_NEAR(golden.azimuth_deg, 194.34024, 0.05);
  // At 0h TD, 59 s before which UTC is: the ascension less Greenwich's sidereal time of 0h UT is where the sun culminates.
  const double day = julian_day(1992, 10, 13, -59.0 / 3600.0);
  const double greenwich = 280.46061837 + 360.98564736629 * (day - 2451545.0);
  const double east = 198.38083 - (greenwich - 360.0 * std::floor(greenwich / 360.0));
  EXPECT_NEAR(sun_position(day, -7.78507, east).elevation_deg, 90.0, 0.05);
  EXPECT_NEAR(sun_position(day, -7.78507 + 45.0, east).azimuth_deg, 180.0, 0.05);
}

TEST(SunPosition, DaysAreCountedAsMeeusDoes) {
  EXPECT_EQ(julian_day(2000, 1, 1, 12.0), 2451545.0);  // ch. 7
  EXPECT_EQ(julian_day(1987, 1, 27, 0.0), 2446822.5);
  EXPECT_EQ(julian_day(1988, 6, 19, 12.0), 2447332.0);
  EXPECT_EQ(julian_day(1957, 10, 4, 0.81 * 24.0), 2436116.31);
}

}  // namespace
}  // namespace splatray
