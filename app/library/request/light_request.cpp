#include "app/library/request/light_request.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "app/library/request/value_text.h"
#include "engine/base/nearest_name.h"
#include "engine/base/number_text.h"

namespace splatray {
namespace {

using Values = std::map<std::string, std::vector<double>>;

/// Kinds of lights as texts have them, a bit each: what each has of LIGHT_KEYS.
enum KindBits : unsigned {
  POINT = 1,
  SPOT = 2,
  SUN = 4,
  RECTANGLE = 8,
  PLACED = POINT | SPOT | RECTANGLE,
  EVERY = PLACED | SUN
};
struct LightKind {
  const char* name;
  KindBits bit;
  std::uint32_t kind;  ///< LIGHT_*
};
constexpr std::array LIGHT_KINDS = {
    LightKind{"point", POINT, LIGHT_POINT}, LightKind{"spot", SPOT, LIGHT_POINT},
    LightKind{"sun", SUN, LIGHT_DIRECTIONAL}, LightKind{"rectangle", RECTANGLE, LIGHT_RECTANGLE}};

/// A number or vector of a light: what it is called, which kinds have it and which of these must, how many numbers it is, and its
/// least and most.
struct LightKey {
  const char* name;
  unsigned kinds, needed;
  std::size_t count;
  double least, most;
  const char* help;
};
constexpr double FARTHEST = 1e30;
constexpr std::array LIGHT_KEYS = {
    LightKey{"at", PLACED, PLACED, 3, -FARTHEST, FARTHEST, "place X,Y,Z"},
    LightKey{"from", SUN, SUN, 3, -FARTHEST, FARTHEST, "direction X,Y,Z that a sun's light comes from"},
    LightKey{"to", SPOT | RECTANGLE, SPOT | RECTANGLE, 3, -FARTHEST, FARTHEST,
             "what a spot or rectangle shines at, X,Y,Z"},
    LightKey{"power", EVERY, 0, 3, 0.0, FARTHEST,
             "R,G,B: intensity of a point or spot, irradiance of a sun, radiance of a rectangle; default "
             "irradiance pi, of "
             "points and spots at the scene's centre, of rectangles at what they shine at"},
    LightKey{"radius", POINT | SPOT, 0, 1, 0.0, FARTHEST, "of a point or spot, world units"},
    LightKey{"angle", SUN, 0, 1, 0.0, 180.0, "that a sun seems to have, degrees"},
    LightKey{"cone", SPOT, SPOT, 1, 1e-3, 90.0, "from a spot's axis to where it is dark, degrees"},
    LightKey{"inner", SPOT, 0, 1, 0.0, 90.0,
             "from its axis to where it begins to fall off, degrees; default 0"},
    LightKey{"range", POINT | SPOT, 0, 1, 1e-30, FARTHEST, "how far a point or spot shines, world units"},
    LightKey{"width", RECTANGLE, RECTANGLE, 1, 1e-30, FARTHEST, "of a rectangle, world units"},
    LightKey{"height", RECTANGLE, RECTANGLE, 1, 1e-30, FARTHEST, "likewise"},
    LightKey{"up", RECTANGLE, 0, 3, -FARTHEST, FARTHEST,
             "where a rectangle's height points to; default the scene's up direction"}};

std::string key_names(unsigned kind) {
  std::string names;
  for (const LightKey& key : LIGHT_KEYS)
    if ((key.kinds & kind) != 0) names += (names.empty() ? "" : ", ") + std::string(key.name) + "=";
  return names;
}

/// The names of all kinds with what is behind each: "point:, spot: or sun:".
std::string kind_names(const char* behind) {
  std::string names;
  for (const LightKind& kind : LIGHT_KINDS) {
    const bool last = &kind == &LIGHT_KINDS.back();
    names += std::string(names.empty() ? "" : (last ? " or " : ", ")) + kind.name + behind;
  }
  return names;
}

const LightKind& read_kind(const std::string& name) {
  std::vector<std::string> names;
  for (const LightKind& kind : LIGHT_KINDS) {
    if (name == kind.name) return kind;
    names.emplace_back(kind.name);
  }
  throw Expected{"a light of the kind " + kind_names(":") + did_you_mean(name, names)};
}

/// That of a light whose LIGHT_* is one of the table's.
const LightKind& kind_of(const SceneLight& light) {
  const auto is_it = [&](const LightKind& kind) {
    return kind.kind == light.kind && (kind.kind != LIGHT_POINT || (kind.bit == SPOT) == is_spot(light));
  };
  return *std::find_if(LIGHT_KINDS.begin(), LIGHT_KINDS.end(), is_it);
}

const LightKey& key_of(const std::string& name, const LightKind& kind) {
  for (const LightKey& key : LIGHT_KEYS)
    if (name == key.name && (key.kinds & kind.bit) != 0) return key;
  throw Expected{std::string("of a ") + kind.name + " some of " + key_names(kind.bit)};
}

/// The numbers of each key: of key=1,2,3,other=4 the parts without = belong to the key before.
Values read_values(const std::string& text, const LightKind& kind) {
  Values values;
  const LightKey* key = nullptr;
  for (std::string part : split_names(text)) {
    if (const std::size_t equals = part.find('='); equals != std::string::npos) {
      key = &key_of(part.substr(0, equals), kind);
      values[key->name].clear();
      part = part.substr(equals + 1);
    }
    if (key == nullptr) key = &key_of("", kind);
    values[key->name].push_back(read_number(part, key->least, key->most, /*whole=*/false));
  }
  for (const LightKey& known : LIGHT_KEYS) {
    if ((known.needed & kind.bit) != 0 && !values.contains(known.name))
      throw Expected{std::string(known.name) + "= of a " + kind.name};
    if (values.contains(known.name) && values[known.name].size() != known.count)
      throw Expected{std::to_string(known.count) + (known.count == 1 ? " number" : " numbers") + " in " +
                     known.name + "="};
  }
  return values;
}

double number_of(const Values& values, const char* name, double other = 0.0) {
  const auto found = values.find(name);
  return found == values.end() ? other : found->second[0];
}
glm::dvec3 vector_of(const Values& values, const char* name) {
  const std::vector<double>& numbers = values.at(name);
  return {numbers[0], numbers[1], numbers[2]};
}

constexpr double DEGREES_ACROSS_A_RADIAN = 360.0 / std::numbers::pi,
                 DEGREES_A_RADIAN = 180.0 / std::numbers::pi;

/// Radians as the degrees that were read, where there are such with few digits: `factor` degrees each.
double degrees_of(double radians, double factor) {
  const double degrees = radians * factor, rounded = std::round(degrees * 1e9) / 1e9;
  return rounded / factor == radians ? rounded : degrees;
}

glm::dvec3 direction_between(const glm::dvec3& at, const glm::dvec3& to) {
  if (at == to) throw Expected{"a place to= other than at="};
  return glm::normalize(to - at);
}

void set_spot(const Values& values, SceneLight& light) {
  light.spot_axis = direction_between(light.position, vector_of(values, "to"));
  light.spot_inner = number_of(values, "inner") / DEGREES_A_RADIAN;
  light.spot_outer = number_of(values, "cone") / DEGREES_A_RADIAN;
  if (!(light.spot_inner < light.spot_outer)) throw Expected{"inner= less than cone="};
}

void set_rectangle(const Values& values, LightRequest& asked) {
  SceneLight& light = asked.light;
  const glm::dvec3 to = vector_of(values, "to"), normal = direction_between(light.position, to);
  const glm::dvec2 edges(number_of(values, "width"), number_of(values, "height"));
  if (!values.contains("up")) {
    asked.level = {to, edges};
    return;
  }
  const glm::dvec3 across = glm::cross(vector_of(values, "up"), normal);
  if (!(glm::length(across) > 0.0)) throw Expected{"a direction up= other than the one it shines in"};
  if (!asked.has_power) {
    const double squared_distance = glm::dot(to - light.position, to - light.position);
    light.power = glm::vec3(static_cast<float>(std::numbers::pi * squared_distance / (edges.x * edges.y)));
    asked.has_power = true;
  }
  light.edge_u = 0.5 * edges.x * glm::normalize(across);
  light.edge_v = 0.5 * edges.y * glm::normalize(glm::cross(normal, across));
}

}  // namespace

double sun_degrees(const SceneLight& sun) { return degrees_of(sun.size, DEGREES_ACROSS_A_RADIAN); }

std::string light_kind_names() { return kind_names(""); }

const char* light_kind_name(const SceneLight& light) { return kind_of(light).name; }

std::string light_keys_help() {
  std::string help;
  for (const LightKey& key : LIGHT_KEYS)
    help += std::string(help.empty() ? "" : "; ") + key.name + "=: " + key.help;
  return help;
}

LightRequest read_light(const std::string& text) {
  const std::string kind_name = text.substr(0, text.find(':'));
  const LightKind& kind = read_kind(kind_name);
  const Values values = read_values(text.substr(std::min(kind_name.size() + 1, text.size())), kind);
  LightRequest asked;
  SceneLight& light = asked.light;
  light.kind = kind.kind;
  light.position = vector_of(values, kind.bit == SUN ? "from" : "at");
  if (light.position == glm::dvec3(0.0) && kind.bit == SUN)
    throw Expected{"a direction from= other than 0,0,0"};
  asked.has_power = values.contains("power");
  if (asked.has_power) light.power = vector_of(values, "power");
  light.size =
      kind.bit == SUN ? number_of(values, "angle") / DEGREES_ACROSS_A_RADIAN : number_of(values, "radius");
  light.range = number_of(values, "range");
  if (kind.bit == SPOT) set_spot(values, light);
  if (kind.bit == RECTANGLE) set_rectangle(values, asked);
  return asked;
}

std::string light_text(const LightRequest& asked) {
  const SceneLight& light = asked.light;
  const LightKind& kind = kind_of(light);
  const bool sun = kind.bit == SUN;
  std::string text = kind.name + std::string(sun ? ":from=" : ":at=") + number_text(light.position);
  const auto add = [&text](const char* key, const std::string& value) {
    text += std::string(",") + key + "=" + value;
  };
  if (kind.bit == SPOT) {
    add("to", number_text(light.position + light.spot_axis));
    add("cone", number_text(degrees_of(light.spot_outer, DEGREES_A_RADIAN)));
    if (light.spot_inner > 0.0) add("inner", number_text(degrees_of(light.spot_inner, DEGREES_A_RADIAN)));
  }
  if (kind.bit == RECTANGLE) {
    add("to", number_text(light.position + glm::normalize(glm::cross(light.edge_u, light.edge_v))));
    add("width", number_text(2.0 * glm::length(light.edge_u)));
    add("height", number_text(2.0 * glm::length(light.edge_v)));
    add("up", number_text(glm::normalize(light.edge_v)));
  }
  if (asked.has_power) add("power", number_text(light.power));
  if (light.size > 0.0)
    sun ? add("angle", number_text(sun_degrees(light))) : add("radius", number_text(light.size));
  if (light.range > 0.0) add("range", number_text(light.range));
  return text;
}

}  // namespace splatray
