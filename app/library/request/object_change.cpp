#include "app/library/request/object_change.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cstring>
#include <functional>
#include <limits>
#include <map>

#include "app/library/materials.h"
#include "app/library/request/value_text.h"
#include "engine/base/error.h"
#include "engine/base/number_text.h"
#include "engine/scene/surface.h"
#include "preprocess/base/quoted_list.h"

namespace splatray {
namespace {

[[noreturn]] void refuse(const std::string& found, const std::string& expected) {
  throw Error(ExitCode::usage, "--object: found '" + found + "', expected " + expected);
}

/// A key: how its value is read into options, and written, empty where it is unset.
struct Key {
  std::string name;
  std::function<void(const std::string& value, ObjectChange&)> read;
  std::function<std::string(const ObjectChange&)> write;
};

Key preset_key() {
  const auto read = [](const std::string& value, ObjectChange& options) {
    const std::vector<std::string> names = material_names();
    if (std::find(names.begin(), names.end(), value) == names.end())
      refuse("preset=" + value, "one of " + quoted_list(names));
    options.preset = value;
  };
  return {"preset", read, [](const ObjectChange& options) { return options.preset; }};
}

Key color_key(const std::string& name, std::optional<glm::vec3> ObjectChange::*member, double most = 1.0) {
  const auto read = [=](const std::string& value, ObjectChange& options) {
    const auto numbers = split_numbers(value, '/', 3);
    const auto in_range = [most](double x) { return x >= 0.0 && x <= most; };
    if (numbers.empty() || !std::all_of(numbers.begin(), numbers.end(), in_range))
      refuse(name + "=" + value, "three numbers from 0 to " + number_text(most) + " such as 0.8/0.5/0.2");
    options.*member = glm::vec3(numbers[0], numbers[1], numbers[2]);
  };
  const auto write = [=](const ObjectChange& options) {
    return options.*member ? number_text(*(options.*member), '/') : "";
  };
  return {name, read, write};
}

Key number_key(const std::string& name, std::optional<float> ObjectChange::*member, double least,
               double most) {
  const auto read = [=](const std::string& value, ObjectChange& options) {
    const auto numbers = split_numbers(value, '/', 1);
    if (numbers.empty() || !(numbers[0] >= least && numbers[0] <= most))
      refuse(name + "=" + value, "a number from " + number_text(least) + " to " + number_text(most));
    options.*member = static_cast<float>(numbers[0]);
  };
  const auto write = [=](const ObjectChange& options) {
    return options.*member ? number_text(*(options.*member)) : "";
  };
  return {name, read, write};
}

Key switch_key(const std::string& name, std::optional<bool> ObjectChange::*member) {
  const auto read = [=](const std::string& value, ObjectChange& options) {
    if (value != "on" && value != "off") refuse(name + "=" + value, "on or off");
    options.*member = value == "on";
  };
  const auto write = [=](const ObjectChange& options) -> std::string {
    if (!(options.*member)) return "";
    return *(options.*member) ? "on" : "off";
  };
  return {name, read, write};
}

const std::vector<Key>& keys() {
  constexpr double MOST = 1e6, LEAST_IOR = 1e-3;
  static const std::vector<Key> KEYS = {preset_key(),
                                        color_key("diffuse", &ObjectChange::diffuse),
                                        number_key("specular", &ObjectChange::specular, 0.0, 1.0),
                                        number_key("shininess", &ObjectChange::shininess, 1.0, MOST),
                                        number_key("mirror", &ObjectChange::mirror, 0.0, 1.0),
                                        number_key("ior", &ObjectChange::ior, LEAST_IOR, MOST),
                                        color_key("tint", &ObjectChange::tint),
                                        switch_key("glass", &ObjectChange::glass),
                                        switch_key("two-sided", &ObjectChange::two_sided),
                                        switch_key("hidden", &ObjectChange::hidden),
                                        number_key("metallic", &ObjectChange::metallic, 0.0, 1.0),
                                        number_key("roughness", &ObjectChange::roughness, 0.0, 1.0),
                                        number_key("coat", &ObjectChange::coat, 0.0, 1.0),
                                        number_key("coat-roughness", &ObjectChange::coat_roughness, 0.0, 1.0),
                                        color_key("emission", &ObjectChange::emission, MOST)};
  return KEYS;
}

void read_pair(const std::string& pair, ObjectChange& options) {
  const std::size_t equals = pair.find('=');
  std::vector<std::string> names;
  for (const Key& key : keys()) {
    names.push_back(key.name);
    if (equals != std::string::npos && pair.substr(0, equals) == key.name)
      return key.read(pair.substr(equals + 1), options);
  }
  refuse(pair, "key=value with a key of " + quoted_list(names));
}

/// The index that a text is, if it is one.
std::optional<std::size_t> whole_number(const std::string& text) {
  std::size_t number = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return stop == end && error == std::errc() ? std::optional(number) : std::nullopt;
}

std::size_t find_object(const std::string& object, const std::vector<std::string>& names) {
  if (const auto index = whole_number(object)) {
    if (*index < names.size()) return *index;
    refuse(object, "an object's name or an index below " + std::to_string(names.size()));
  }
  const auto found = std::find(names.begin(), names.end(), object);
  if (found == names.end()) refuse(object, "an object's index or name: " + quoted_list(names));
  if (std::find(found + 1, names.end(), object) != names.end())
    refuse(object, "an index, as several objects have this name");
  return static_cast<std::size_t>(found - names.begin());
}

/// What find_object finds the object by: its name where that is plain text that no other has, else its index.
std::string object_key(std::size_t object, const std::vector<std::string>& names) {
  const std::string& name = names[object];
  const bool plain =
      std::none_of(name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; });
  const bool usable = plain && !name.empty() && !whole_number(name);
  return usable && std::count(names.begin(), names.end(), name) == 1 ? name : std::to_string(object);
}

void set_flag(Material& material, std::uint32_t flag, std::optional<bool> on) {
  if (on) material.flags = *on ? material.flags | flag : material.flags & ~flag;
}

void apply(const ObjectChange& options, Material& material, Surface& surface) {
  if (!options.preset.empty()) {
    change_material(material, options.preset);
    surface = surface_of(material);
  }
  const Material before = material;
  material.diffuse = options.diffuse.value_or(material.diffuse);
  material.specular = options.specular.value_or(material.specular);
  material.tint = options.tint.value_or(material.tint);
  material.shininess = options.shininess.value_or(material.shininess);
  material.mirror = options.mirror.value_or(material.mirror);
  material.ior = options.ior.value_or(material.ior);
  set_flag(material, MATERIAL_DIELECTRIC, options.glass);
  set_flag(material, MATERIAL_TWO_SIDED, options.two_sided);
  set_flag(material, MATERIAL_HIDDEN, options.hidden);
  surface = surface_after(before, surface, material);
  surface.metallic = options.metallic.value_or(surface.metallic);
  surface.roughness = options.roughness.value_or(surface.roughness);
  surface.coat = options.coat.value_or(surface.coat);
  surface.coat_roughness = options.coat_roughness.value_or(surface.coat_roughness);
  surface.emission = options.emission.value_or(surface.emission);
}

/// Lays the keys that `change` has over those said before.
void add(const ObjectChange& change, ObjectChange& said) {
  for (const Key& key : keys())
    if (const std::string value = key.write(change); !value.empty()) key.read(value, said);
}

void set_difference(const Surface& from, const Surface& to, ObjectChange& options) {
  const auto set = [](auto& option, const auto& before, const auto& after) {
    if (before != after) option = after;
  };
  set(options.metallic, from.metallic, to.metallic);
  set(options.roughness, from.roughness, to.roughness);
  set(options.coat, from.coat, to.coat);
  set(options.coat_roughness, from.coat_roughness, to.coat_roughness);
  set(options.emission, from.emission, to.emission);
}

ObjectChange difference(const Material& from, const Material& to) {
  ObjectChange options;
  const auto set = [](auto& option, const auto& before, const auto& after) {
    if (before != after) option = after;
  };
  const auto has = [](const Material& material, std::uint32_t flag) { return (material.flags & flag) != 0; };
  set(options.diffuse, from.diffuse, to.diffuse);
  set(options.specular, from.specular, to.specular);
  set(options.tint, from.tint, to.tint);
  set(options.shininess, from.shininess, to.shininess);
  set(options.mirror, from.mirror, to.mirror);
  set(options.ior, from.ior, to.ior);
  set(options.glass, has(from, MATERIAL_DIELECTRIC), has(to, MATERIAL_DIELECTRIC));
  set(options.two_sided, has(from, MATERIAL_TWO_SIDED), has(to, MATERIAL_TWO_SIDED));
  set(options.hidden, has(from, MATERIAL_HIDDEN), has(to, MATERIAL_HIDDEN));
  return options;
}

}  // namespace

ObjectChange read_object_change(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || colon == 0 || colon + 1 == text.size())
    refuse(text, "OBJECT:key=value,... such as dragon:preset=gold");
  ObjectChange options;
  options.object = text.substr(0, colon);
  std::istringstream pairs(text.substr(colon + 1));
  for (std::string pair; std::getline(pairs, pair, ',');) read_pair(pair, options);
  return options;
}

std::string object_text(const ObjectChange& options) {
  std::string text;
  for (const Key& key : keys()) {
    const std::string value = key.write(options);
    if (!value.empty()) text += (text.empty() ? ":" : ",") + key.name + "=" + value;
  }
  return options.object + text;
}

Surface surface_after(const Material& before, const Surface& surface, const Material& after) {
  const Surface from = surface_of(before), to = surface_of(after);
  if (std::memcmp(&from, &to, sizeof(Surface)) == 0) return surface;
  Surface next = to;
  const auto keep = [&](auto Surface::*member) {
    if (surface.*member != from.*member) next.*member = surface.*member;
  };
  for (float Surface::*number :
       {&Surface::metallic, &Surface::roughness, &Surface::coat, &Surface::coat_roughness})
    keep(number);
  keep(&Surface::emission);
  return next;
}

bool changes_look(const ObjectChange& options) {
  ObjectChange sides;
  sides.object = options.object;
  sides.two_sided = options.two_sided;
  sides.hidden = options.hidden;
  return options != sides;
}

void apply_object_changes(const std::vector<ObjectChange>& options, const std::vector<std::string>& names,
                          ObjectLooks& looks) {
  std::map<std::size_t, ObjectChange> said;
  for (const ObjectChange& change : options) add(change, said[find_object(change.object, names)]);
  for (const auto& [object, change] : said) apply(change, looks.materials[object], looks.surfaces[object]);
}

std::vector<ObjectChange> object_changes_between(const ObjectLooks& loaded, const ObjectLooks& shown,
                                                 const std::vector<std::string>& names) {
  assert(loaded.materials.size() == shown.materials.size() && names.size() == shown.materials.size());
  std::vector<ObjectChange> changes;
  for (std::size_t i = 0; i < shown.materials.size(); ++i) {
    ObjectChange change = difference(loaded.materials[i], shown.materials[i]);
    const Surface before = surface_after(loaded.materials[i], loaded.surfaces[i], shown.materials[i]);
    set_difference(before, shown.surfaces[i], change);
    if (change == ObjectChange{}) continue;
    change.object = object_key(i, names);
    changes.push_back(std::move(change));
  }
  return changes;
}

}  // namespace splatray
