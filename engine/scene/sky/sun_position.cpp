#include "engine/scene/sky/sun_position.h"

#include <cmath>
#include <numbers>

namespace splatray {
namespace {

constexpr double RADIANS = std::numbers::pi / 180.0;

double sin_deg(double degrees) { return std::sin(degrees * RADIANS); }
double cos_deg(double degrees) { return std::cos(degrees * RADIANS); }
/// 0 up to 360.
double full_turn(double degrees) { return degrees - 360.0 * std::floor(degrees / 360.0); }

/// Apparent right ascension and declination, degrees, `centuries` of Julian days after the epoch J2000.0.
struct Equatorial {
  double ascension, declination;
};
Equatorial sun_at(double centuries) {
  const double t = centuries;
  const double mean_longitude = 280.46646 + t * (36000.76983 + t * 0.0003032);
  const double anomaly = 357.52911 + t * (35999.05029 - t * 0.0001537);
  const double center = (1.914602 - t * (0.004817 + t * 0.000014)) * sin_deg(anomaly) +
                        (0.019993 - 0.000101 * t) * sin_deg(2.0 * anomaly) +
                        0.000289 * sin_deg(3.0 * anomaly);
  const double node = 125.04 - 1934.136 * t;  // of the moon's orbit, for nutation
  const double longitude = mean_longitude + center - 0.00569 - 0.00478 * sin_deg(node);
  const double obliquity =
      23.439291 - t * (0.0130042 + t * (1.64e-7 - t * 5.04e-7)) + 0.00256 * cos_deg(node);
  return {std::atan2(cos_deg(obliquity) * sin_deg(longitude), cos_deg(longitude)) / RADIANS,
          std::asin(sin_deg(obliquity) * sin_deg(longitude)) / RADIANS};
}

/// What the air lifts a body by that stands this high without it, degrees.
double refraction_deg(double elevation_deg) {
  constexpr double LEAST = -1.0;  // where it is below the horizon in any case
  if (elevation_deg < LEAST) return 0.0;
  return 1.02 / 60.0 / std::tan((elevation_deg + 10.3 / (elevation_deg + 5.11)) * RADIANS);
}

}  // namespace

double julian_day(int year, int month, int day, double hours) {
  if (month <= 2) {
    --year;
    month += 12;
  }
  const double centuries = std::floor(year / 100.0);
  const double leap = 2.0 - centuries + std::floor(centuries / 4.0);
  return std::floor(365.25 * (year + 4716)) + std::floor(30.6001 * (month + 1)) + day + leap - 1524.5 +
         hours / 24.0;
}

SunPosition sun_position(double julian_day_utc, double latitude_deg, double longitude_deg) {
  constexpr double J2000 = 2451545.0, CENTURY = 36525.0;
  const double days = julian_day_utc - J2000, t = days / CENTURY;
  const Equatorial sun = sun_at(t);
  const double sidereal = 280.46061837 + 360.98564736629 * days + t * t * 0.000387933;
  const double hour_angle = sidereal + longitude_deg - sun.ascension;
  const double elevation = std::asin(sin_deg(latitude_deg) * sin_deg(sun.declination) +
                                     cos_deg(latitude_deg) * cos_deg(sun.declination) * cos_deg(hour_angle)) /
                           RADIANS;
  const double from_south =
      std::atan2(sin_deg(hour_angle) * cos_deg(sun.declination),
                 cos_deg(hour_angle) * sin_deg(latitude_deg) * cos_deg(sun.declination) -
                     sin_deg(sun.declination) * cos_deg(latitude_deg)) /
      RADIANS;
  return {elevation + refraction_deg(elevation), full_turn(from_south + 180.0)};
}

}  // namespace splatray
