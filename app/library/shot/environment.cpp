#include "app/library/shot/environment.h"

#include <cmath>
#include <string_view>

#include "app/library/image_file.h"
#include "app/library/request/value_text.h"
#include "engine/base/error.h"
#include "engine/base/number_text.h"
#include "engine/scene/sky/daylight.h"

namespace splatray {
namespace {

constexpr std::string_view SKY = "sky:";

Daylight read_daylight(const std::string& name) {
  const std::string text = name.substr(SKY.size());
  std::vector<double> numbers = split_numbers(text, ',', 2);
  if (numbers.empty()) numbers = split_numbers(text, ',', 3);
  Daylight day;
  if (numbers.size() == 3) day.turbidity = numbers[2];
  if (numbers.empty() || !(numbers[0] > 0.0 && numbers[0] <= 90.0) || !(std::abs(numbers[1]) <= 360.0) ||
      !(day.turbidity >= 2.0 && day.turbidity <= 10.0))
    throw Error(
        ExitCode::usage,
        "--environment: found '" + name +
            "', expected sky:ELEVATION,AZIMUTH[,TURBIDITY] with an elevation above 0 up to 90 degrees, "
            "an azimuth of up to 360 degrees and a turbidity from 2 to 10");
  day.sun_elevation_deg = numbers[0];
  day.sun_azimuth_deg = numbers[1];
  return day;
}

}  // namespace

std::optional<Environment> built_in_environment(const std::string& name) {
  if (name.empty() || name == "studio") return studio_environment();
  if (name == "white") return Environment{0, 0, {}, vec3(1.0F)};
  if (name == "black") return Environment{0, 0, {}, vec3(0.0F)};
  if (name.starts_with(SKY)) return daylight_environment(read_daylight(name));
  const std::vector<double> numbers = split_numbers(name, ',', 3);
  if (numbers.empty()) return {};
  const vec3 radiance(numbers[0], numbers[1], numbers[2]);
  if (!(glm::all(glm::greaterThanEqual(radiance, vec3(0.0F))) &&
        std::isfinite(radiance.x + radiance.y + radiance.z)))
    throw Error(ExitCode::usage,
                "--environment: found '" + name + "', expected a radiance of finite numbers >= 0");
  return Environment{0, 0, {}, radiance};
}

Environment load_environment(const std::string& name, const std::function<void(const std::string&)>& note) {
  auto environment = built_in_environment(name);
  return environment ? *std::move(environment) : read_environment(name, note);
}

}  // namespace splatray
