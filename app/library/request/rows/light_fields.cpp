#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "app/library/request/daylight_text.h"
#include "app/library/request/fields.h"
#include "engine/base/number_text.h"

namespace splatray {
namespace {

constexpr FieldGroup LIGHT = FieldGroup::light;

/// Finite numbers, `least` of them or three more, or either and a last one; how many there are stands in their count.
std::vector<double> light_numbers(const std::string& text, std::size_t least, const std::string& expected) {
  for (const std::size_t count : {least, least + 3, least + 4})
    if (auto numbers = split_numbers(text, ',', count); !numbers.empty()) return numbers;
  throw Expected{expected};
}

void set_power(std::span<const double> numbers, LightRequest& asked) {
  const glm::vec3 power(numbers[0], numbers[1], numbers[2]);
  if (!(power.x >= 0.0F && power.y >= 0.0F && power.z >= 0.0F) || !std::isfinite(power.x + power.y + power.z))
    throw Expected{"R,G,B of finite numbers >= 0"};
  asked.light.power = power;
  asked.has_power = true;
}

/// A light of X,Y,Z[,R,G,B[,SIZE]].
LightRequest read_sized(const std::string& text, std::uint32_t kind) {
  const auto numbers =
      light_numbers(text, 3, "three, six or seven numbers such as 1,-2,0.5 or 1,-2,0.5,9,9,9");
  LightRequest asked;
  asked.light.kind = kind;
  asked.light.position = {numbers[0], numbers[1], numbers[2]};
  const bool sun = kind == LIGHT_DIRECTIONAL;
  if (sun && asked.light.position == glm::dvec3(0.0)) throw Expected{"a direction other than 0,0,0"};
  if (numbers.size() > 3) set_power(std::span(numbers).subspan(3), asked);
  const double size = numbers.size() == 7 ? numbers[6] : 0.0, most = sun ? 180.0 : 1e30;
  if (!(size >= 0.0 && size <= most))
    throw Expected{sun ? "a SIZE from 0 to 180 degrees" : "a SIZE of 0 or more"};
  asked.light.size = sun ? size * std::numbers::pi / 360.0 : size;
  return asked;
}

/// A rectangle of X,Y,Z,TX,TY,TZ,WIDTH,HEIGHT[,R,G,B].
LightRequest read_rectangle(const std::string& text) {
  const auto numbers =
      light_numbers(text, 8, "eight or eleven numbers such as 0,0,3,0,0,0,2,1 or 0,0,3,0,0,0,2,1,9,9,9");
  LightRequest asked;
  asked.light.kind = LIGHT_RECTANGLE;
  asked.light.position = {numbers[0], numbers[1], numbers[2]};
  asked.level = {{numbers[3], numbers[4], numbers[5]}, {numbers[6], numbers[7]}};
  if (asked.light.position == asked.level->target)
    throw Expected{"a point TX,TY,TZ other than X,Y,Z to shine at"};
  if (!(asked.level->edges.x > 0.0 && asked.level->edges.y > 0.0))
    throw Expected{"a WIDTH and HEIGHT of more than 0"};
  if (numbers.size() == 12) throw Expected{"eight or eleven numbers"};
  if (numbers.size() > 8) set_power(std::span(numbers).subspan(8), asked);
  return asked;
}

/// As short as can be: in the spelling by places where that says all of it.
FieldText shortest_text(const LightRequest& asked) {
  const SceneLight& light = asked.light;
  const bool rectangle = light.kind == LIGHT_RECTANGLE, sun = light.kind == LIGHT_DIRECTIONAL;
  if (is_spot(light) || light.range > 0.0 || (is_flat(light.kind) && !asked.level) ||
      (light.size > 0.0 && !asked.has_power))
    return {"light", light_text(asked)};
  std::string text = number_text(light.position);
  if (rectangle)
    text += "," + number_text(asked.level->target) + "," + number_text(asked.level->edges.x) + "," +
            number_text(asked.level->edges.y);
  if (asked.has_power) text += "," + number_text(light.power);
  if (light.size > 0.0) text += "," + number_text(sun ? sun_degrees(light) : light.size);
  return {rectangle ? "area-light" : (sun ? "sun" : "light"), text};
}

/// One of the family of lights, which keeps the order in which they are given; the first replaces those there were.
Field light_row(std::string name, std::uint32_t kind, std::string value, std::string help) {
  Field row = value_row(std::move(name), LIGHT, std::move(value), std::move(help),
                        [kind](Request& request, const std::string& text) {
                          if (!request.look.lights) request.look.lights.emplace();
                          const bool named = kind == LIGHT_POINT && text.find(':') != std::string::npos;
                          request.look.lights->push_back(named                     ? read_light(text)
                                                         : kind == LIGHT_RECTANGLE ? read_rectangle(text)
                                                                                   : read_sized(text, kind));
                        },
                        {});
  row.repeated = true;
  row.family = "lights";
  row.clear = [](Request& request) { request.look.lights.emplace(); };
  return row;
}

/// No light, and the one field of the family that writes.
Field lights_row() {
  Field row = light_row("lights", LIGHT_POINT, "none",
                        "no light but the environment's, unless --light, --sun or --area-light add some");
  row.read = [](Request&, const std::string& text) {
    if (text != "none") throw Expected{"none"};
  };
  row.write = [](const Request& request) {
    std::vector<FieldText> texts;
    if (!request.look.lights) return texts;
    for (const LightRequest& light : *request.look.lights) texts.push_back(shortest_text(light));
    if (texts.empty()) texts.push_back({"lights", "none"});
    return texts;
  };
  return row;
}

Field environment_row() {
  return with(
      value_row(
          "environment", LIGHT, "FILE|NAME",
          "an HDR or EXR file (latitude-longitude), white, black, studio, "
          "sky:ELEVATION,AZIMUTH[,TURBIDITY] (daylight in W/m2: where the sun stands, degrees above the "
          "horizon and clockwise from north, and how hazy it is, 2 to 10, default 3), "
          "sky:DATE,LATITUDE,LONGITUDE[,TURBIDITY] (as --sun-at has it) or a radiance "
          "r,g,b; default: the scene's, else studio with a key light over the viewer's left shoulder",
          [](Request& request, const std::string& text) { request.look.environment = text; },
          [](const Request& request) { return request.look.environment; }),
      {.old_names = {"env"}});
}

/// Another way to say an environment, which is what it becomes.
Field sun_at_row() {
  return value_row("sun-at", LIGHT, "DATE,LATITUDE,LONGITUDE[,TURBIDITY]",
                   "the daylight of a place at a time as environment, such as "
                   "2026-06-21T15:00+02:00,48.1,11.6: date and time with its zone, Z or +HH:MM, of 1950 to "
                   "2050, degrees north and east, and how hazy it is, 2 to 10, default 3; north is the "
                   "world's +y, of scenes whose up is y -z",
                   [](Request& request, const std::string& text) {
                     static_cast<void>(read_daylight(text));
                     request.look.environment = DAYLIGHT_NAME + text;
                   },
                   {});
}

Field background_row() {
  return value_row(
      "background", LIGHT, "auto|environment|transparent|R,G,B",
      "what is seen where nothing is met: the environment, nothing (a PNG or WebP gets an alpha channel), or "
      "a radiance; light comes from the environment all the same; default auto: the environment, or dark "
      "around scanners in the open where none is named",
      [](Request& request, const std::string& text) {
        Request::Settings& settings = request.settings;
        std::optional<glm::vec3> radiance;
        if (text != "auto" && text != "environment" && text != "transparent") {
          const std::vector<double> numbers = split_numbers(text, ',', 3);
          const auto usable = [](double x) { return x >= 0.0 && x <= 1e9; };
          if (numbers.empty() || !std::all_of(numbers.begin(), numbers.end(), usable))
            throw Expected{"auto, environment, transparent or three numbers from 0 to 1e9"};
          radiance = glm::vec3(numbers[0], numbers[1], numbers[2]);
        }
        settings.transparent = text == "transparent";
        settings.asked_environment_seen = text == "environment";
        settings.background = radiance;
      },
      [](const Request& request) -> std::string {
        if (request.settings.transparent) return "transparent";
        if (request.settings.background) return number_text(*request.settings.background);
        return request.settings.asked_environment_seen ? "environment" : "auto";
      });
}

}  // namespace

std::vector<Field> light_fields() {
  return {
      light_row("light", LIGHT_POINT, "KIND:KEY=VALUE,...|X,Y,Z[,R,G,B[,SIZE]]",
                "a " + light_kind_names() +
                    " instead of the scene's lights, such as "
                    "spot:at=0,3,0,to=0,0,0,cone=17,range=9; " +
                    light_keys_help() +
                    "; or by places a point: where it is, its intensity and radius; repeatable"),
      needed(light_row("sun", LIGHT_DIRECTIONAL, "X,Y,Z[,R,G,B[,SIZE]]",
                       "a directional light from X,Y,Z instead of the scene's lights; R,G,B: its irradiance, "
                       "default pi; SIZE: the angle it seems to have, degrees (our sun's: 0.53); repeatable"),
             "a sun in this direction"),
      light_row("area-light", LIGHT_RECTANGLE, "X,Y,Z,TX,TY,TZ,W,H[,R,G,B]",
                "a rectangle of W x H here that shines towards TX,TY,TZ, instead of the scene's lights; "
                "R,G,B: its radiance, default irradiance pi there; with --look paper a point; repeatable"),
      lights_row().of_looks({LOOK_PAPER, LOOK_LIT, LOOK_CLAY, LOOK_SCAN}),
      needed(environment_row(), "an HDR or EXR, white, studio, sky:ELEVATION,AZIMUTH"),
      sun_at_row(),
      background_row(),
      with(number_row("environment-strength", LIGHT, MEMBER(settings.environment_strength), 0.0, 1e6,
                      "factor on the environment; default 1"),
           {.old_names = {"env-strength"}}),
      with(number_row("environment-turn", LIGHT, MEMBER(settings.environment_turn), -1e6, 1e6,
                      "full turns of the environment about the up axis, counter-clockwise seen from above; "
                      "default 0"),
           {.old_names = {"env-turn"}})};
}

}  // namespace splatray
