#include "app/library/shot/environment.h"

#include <cmath>
#include <string_view>

#include "app/library/image_file.h"
#include "app/library/request/daylight_text.h"
#include "app/library/request/value_text.h"
#include "engine/base/error.h"
#include "engine/base/number_text.h"

namespace splatray {
namespace {

Environment daylight_of(const std::string& name) {
  try {
    return daylight_environment(read_daylight(name.substr(std::string_view(DAYLIGHT_NAME).size())));
  } catch (const Expected& expected) {
    throw Error(ExitCode::usage, "--environment: found '" + name + "', expected " + expected.what);
  }
}

}  // namespace

std::optional<Environment> built_in_environment(const std::string& name) {
  if (name.empty() || name == "studio") return studio_environment();
  if (name == "white") return Environment{0, 0, {}, vec3(1.0F)};
  if (name == "black") return Environment{0, 0, {}, vec3(0.0F)};
  if (is_daylight(name)) return daylight_of(name);
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
