/// Where the sun stands.
#pragma once

namespace splatray {

/// As an observer at sea level sees it.
struct SunPosition {
  double elevation_deg = 0.0;  ///< above the horizon, with refraction
  double azimuth_deg = 0.0;    ///< clockwise from north, 0 up to 360
};

/// Days since noon UTC of 1 January 4713 BC of a date of the Gregorian calendar (Meeus 1998, ch. 7); `hours` after its midnight UTC, any.
[[nodiscard]] double julian_day(int year, int month, int day, double hours);

/// Within 0.02 degrees from 1950 to 2050: Meeus 1998, "Astronomical Algorithms", ch. 25 (the sun, low accuracy), 22 (obliquity), 12
/// (sidereal time), 13 (horizontal coordinates) and 16 (refraction by Saemundsson). Latitude north and longitude east, degrees.
[[nodiscard]] SunPosition sun_position(double julian_day_utc, double latitude_deg, double longitude_deg);

}  // namespace splatray
