#include "app/library/request/daylight_text.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "app/library/request/value_text.h"
#include "engine/base/number_text.h"
#include "engine/scene/sky/sun_position.h"

namespace splatray {
namespace {

constexpr double HIGHEST_DEG = 90.0, CLEAREST = 2.0, HAZIEST = 10.0;

[[noreturn]] void refuse_date() {
  throw Expected{
      "a date and time with its zone, such as 2026-06-21T15:00+02:00 or 2026-06-21T13:00Z, of 1950 to 2050"};
}

int days_in(int year, int month) {
  constexpr std::array DAYS = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  const bool leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
  return DAYS.at(static_cast<std::size_t>(month - 1)) + (month == 2 && leap ? 1 : 0);
}

/// Hours east of UTC, of Z, +HH:MM or -HH:MM.
double read_zone(const std::string& text) {
  if (text == "Z") return 0.0;
  int hours = 0, minutes = 0, used = 0;
  char sign = 0;
  const bool read =
      std::sscanf(text.c_str(), "%c%2d:%2d%n", &sign, &hours, &minutes, &used) == 3 && text.size() == 6;
  if (!read || used != 6 || (sign != '+' && sign != '-') || hours < 0 || hours > 14 || minutes < 0 ||
      minutes > 59)
    refuse_date();
  return (sign == '-' ? -1.0 : 1.0) * (hours + minutes / 60.0);
}

/// The Julian day of YYYY-MM-DDTHH:MM[:SS] and a zone.
double read_instant(const std::string& text) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, second = 0, used = 0;
  if (std::sscanf(text.c_str(), "%4d-%2d-%2dT%2d:%2d%n", &year, &month, &day, &hour, &minute, &used) != 5 ||
      used != 16)
    refuse_date();
  std::string rest = text.substr(16);
  if (rest.starts_with(':')) {
    used = 0;
    if (std::sscanf(rest.c_str(), ":%2d%n", &second, &used) != 1 || used != 3) refuse_date();
    rest = rest.substr(3);
  }
  const bool real = year >= 1950 && year <= 2050 && month >= 1 && month <= 12 && day >= 1 &&
                    day <= days_in(year, month) && hour >= 0 && hour <= 23 && minute >= 0 && minute <= 59 &&
                    second >= 0 && second <= 59;
  if (!real) refuse_date();
  return julian_day(year, month, day, hour + minute / 60.0 + second / 3600.0 - read_zone(rest));
}

Daylight daylight_at(const std::string& date, const std::vector<double>& place) {
  if (!(std::abs(place[0]) <= 90.0 && std::abs(place[1]) <= 180.0))
    throw Expected{"a latitude from -90 to 90 degrees north and a longitude from -180 to 180 degrees east"};
  const SunPosition sun = sun_position(read_instant(date), place[0], place[1]);
  if (!(sun.elevation_deg > 0.0))
    throw Expected{"a time when the sun is up, which stands at " +
                   number_text(std::round(10.0 * sun.elevation_deg) / 10.0) + " degrees there and then"};
  return {std::min(sun.elevation_deg, HIGHEST_DEG), sun.azimuth_deg, Daylight{}.turbidity};
}

}  // namespace

bool is_daylight(const std::string& environment) { return environment.starts_with(DAYLIGHT_NAME); }

Daylight read_daylight(const std::string& text) {
  const std::size_t comma = std::min(text.find(','), text.size());
  const std::string first = text.substr(0, comma);
  const bool dated = first.find('T') != std::string::npos;
  const std::string numbers_text = dated ? text.substr(std::min(comma + 1, text.size())) : text;
  std::vector<double> numbers = split_numbers(numbers_text, ',', 2);
  if (numbers.empty()) numbers = split_numbers(numbers_text, ',', 3);
  if (numbers.empty())
    throw Expected{
        "ELEVATION,AZIMUTH[,TURBIDITY] of the sun or DATE,LATITUDE,LONGITUDE[,TURBIDITY], such as 30,120 or "
        "2026-06-21T15:00+02:00,48.1,11.6"};
  Daylight day;
  if (dated) {
    day = daylight_at(first, numbers);
  } else {
    if (!(numbers[0] > 0.0 && numbers[0] <= HIGHEST_DEG && std::abs(numbers[1]) <= 360.0))
      throw Expected{"an elevation above 0 up to 90 degrees and an azimuth of up to 360 degrees"};
    day.sun_elevation_deg = numbers[0];
    day.sun_azimuth_deg = numbers[1];
  }
  if (numbers.size() == 3) day.turbidity = numbers[2];
  if (!(day.turbidity >= CLEAREST && day.turbidity <= HAZIEST)) throw Expected{"a turbidity from 2 to 10"};
  return day;
}

}  // namespace splatray
