/// Daylight as texts have it.
#pragma once
#include <string>

#include "engine/scene/sky/daylight.h"

namespace splatray {

/// What the name of an environment that is daylight begins with.
inline constexpr const char* DAYLIGHT_NAME = "sky:";
[[nodiscard]] bool is_daylight(const std::string& environment);

/// ELEVATION,AZIMUTH[,TURBIDITY] of the sun, degrees, or a date, time and place whose sun it is: DATE,LATITUDE,LONGITUDE[,TURBIDITY]
/// such as 2026-06-21T15:00+02:00,48.1,11.6, degrees north and east, with the zone Z or +HH:MM; the year is 1950 to 2050. Throws
/// Expected, also for a sun that is not above the horizon there and then.
[[nodiscard]] Daylight read_daylight(const std::string& text);

}  // namespace splatray
