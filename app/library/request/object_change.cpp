#include "app/library/request/object_change.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <functional>
#include <sstream>

#include "app/library/materials.h"
#include "app/library/request/value_text.h"
#include "engine/base/error.h"
#include "engine/base/nearest_name.h"
#include "engine/base/number_text.h"
#include "engine/scene/material_fields.h"
#include "engine/scene/phong.h"
#include "preprocess/base/quoted_list.h"

namespace splatray {
namespace {

[[noreturn]] void refuse(const std::string& found, const std::string& expected) {
  throw Error(ExitCode::usage, "--object: found '" + found + "', expected " + expected);
}

/// What a key changes, in the order in which keys are applied: glTF's numbers follow from Phong's.
enum class Part { preset, phong, gltf };

struct Key {
  std::string name;
  std::string help;  ///< the name and what its values are like
  Part part;
  /// The value as text that reads back to the same; refuses what is out of range.
  std::function<std::string(const std::string& value)> check;
  std::function<void(Material&, const std::string& value)> set;
  std::function<std::string(const Material&)> get;  ///< empty function: a material does not show it
};

Key preset_key() {
  const auto check = [](const std::string& value) {
    const std::vector<std::string> names = material_names();
    if (std::find(names.begin(), names.end(), value) == names.end())
      refuse("preset=" + value, "one of " + quoted_list(names) + did_you_mean(value, names));
    return value;
  };
  return {"preset", "preset (a name of --material)", Part::preset, check, change_material, {}};
}

vec3 read_color(const std::string& text) {
  const auto numbers = split_numbers(text, '/', 3);
  return {numbers[0], numbers[1], numbers[2]};
}

float read_float(const std::string& text) { return static_cast<float>(split_numbers(text, '/', 1)[0]); }

/// `member`: a colour of a material.
template <class Member>
Key color_key(const std::string& name, Part part, Member member, double most = 1.0) {
  const auto check = [=](const std::string& value) {
    const auto numbers = split_numbers(value, '/', 3);
    const auto in_range = [most](double x) { return x >= 0.0 && x <= most; };
    if (numbers.empty() || !std::all_of(numbers.begin(), numbers.end(), in_range))
      refuse(name + "=" + value, "three numbers from 0 to " + number_text(most) + " such as 0.8/0.5/0.2");
    return number_text(read_color(value), '/');
  };
  return {name,
          name + "=r/g/b",
          part,
          check,
          [=](Material& material, const std::string& value) { member(material) = read_color(value); },
          [=](const Material& material) { return number_text(member(material), '/'); }};
}

/// `member`: a number of a material.
template <class Member>
Key number_key(const std::string& name, Part part, Member member, double least, double most) {
  const auto check = [=](const std::string& value) {
    const auto numbers = split_numbers(value, '/', 1);
    if (numbers.empty() || !(numbers[0] >= least && numbers[0] <= most))
      refuse(name + "=" + value, "a number from " + number_text(least) + " to " + number_text(most));
    return number_text(read_float(value));
  };
  return {name,
          name,
          part,
          check,
          [=](Material& material, const std::string& value) { member(material) = read_float(value); },
          [=](const Material& material) { return number_text(member(material)); }};
}

Key flag_key(const std::string& name, std::uint32_t flag) {
  const auto check = [=](const std::string& value) {
    if (value != "on" && value != "off") refuse(name + "=" + value, "on or off");
    return value;
  };
  const auto set = [=](Material& material, const std::string& value) {
    material.flags = value == "on" ? material.flags | flag : material.flags & ~flag;
  };
  const auto get = [=](const Material& material) -> std::string {
    return (material.flags & flag) != 0 ? "on" : "off";
  };
  return {name, name + "=on|off", Part::phong, check, set, get};
}

Key gltf_key(const MaterialField& field) {
  if (field.number != nullptr)
    return number_key(
        field.key, Part::gltf, [=](auto& material) -> auto& { return material.*field.number; }, field.least,
        field.most);
  return color_key(
      field.key, Part::gltf, [=](auto& material) -> auto& { return material.*field.color; }, field.most);
}

std::vector<Key> make_keys() {
  constexpr double MOST = 1e6, LEAST_IOR = 1e-3;
  const auto of = [](auto member) {
    return [=](auto& material) -> auto& { return material.phong.*member; };
  };
  const auto ior = [](auto& material) -> auto& { return material.ior; };
  std::vector<Key> keys = {preset_key(),
                           color_key("diffuse", Part::phong, of(&Phong::diffuse)),
                           number_key("specular", Part::phong, of(&Phong::specular), 0.0, 1.0),
                           number_key("shininess", Part::phong, of(&Phong::shininess), 1.0, MOST),
                           number_key("mirror", Part::phong, of(&Phong::mirror), 0.0, 1.0),
                           number_key("ior", Part::phong, ior, LEAST_IOR, MOST),
                           color_key("tint", Part::phong, of(&Phong::tint)),
                           flag_key("glass", MATERIAL_DIELECTRIC),
                           flag_key("two-sided", MATERIAL_TWO_SIDED),
                           flag_key("hidden", MATERIAL_HIDDEN)};
  for (const MaterialField& field : material_fields())
    if (field.key != nullptr) keys.push_back(gltf_key(field));
  return keys;
}

const std::vector<Key>& keys() {
  static const std::vector<Key> KEYS = make_keys();
  return KEYS;
}

const Key& find_key(const std::string& name, const std::string& said) {
  std::vector<std::string> names;
  for (const Key& key : keys()) {
    if (key.name == name) return key;
    names.push_back(key.name);
  }
  refuse(said, "key=value with a key of " + quoted_list(names) +
                   did_you_mean(said.substr(0, said.find('=')), names));
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
  if (found == names.end())
    refuse(object, "an object's index or name: " + quoted_list(names) + did_you_mean(object, names));
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

/// Sets the keys of a part that are said.
void apply(Part part, const ObjectChange& change, Material& material) {
  for (const Key& key : keys()) {
    const auto value = change.values.find(key.name);
    if (key.part == part && value != change.values.end()) key.set(material, value->second);
  }
}

/// The keys of a part whose values differ.
void add_difference(Part part, const Material& from, const Material& to, ObjectChange& change) {
  for (const Key& key : keys())
    if (key.part == part && key.get(from) != key.get(to)) change.values[key.name] = key.get(to);
}

}  // namespace

void ObjectChange::set(const std::string& key, const std::string& value) {
  values[key] = find_key(key, key).check(value);
}

std::string object_keys_help() {
  std::string help;
  for (const Key& key : keys()) help += (help.empty() ? "" : ", ") + key.help;
  return help;
}

ObjectChange read_object_change(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || colon == 0 || colon + 1 == text.size())
    refuse(text, "OBJECT:key=value,... such as dragon:preset=gold");
  ObjectChange change;
  change.object = text.substr(0, colon);
  std::istringstream pairs(text.substr(colon + 1));
  for (std::string pair; std::getline(pairs, pair, ',');) {
    const std::size_t equals = pair.find('=');
    const Key& key = find_key(equals == std::string::npos ? "" : pair.substr(0, equals), pair);
    change.values[key.name] = key.check(pair.substr(equals + 1));
  }
  return change;
}

std::string object_text(const ObjectChange& change) {
  std::string text;
  for (const Key& key : keys())
    if (const auto value = change.values.find(key.name); value != change.values.end())
      text += (text.empty() ? ":" : ",") + key.name + "=" + value->second;
  return change.object + text;
}

bool changes_look(const ObjectChange& change) {
  return std::any_of(change.values.begin(), change.values.end(),
                     [](const auto& value) { return value.first != "two-sided" && value.first != "hidden"; });
}

void apply_object_changes(const std::vector<ObjectChange>& changes, const std::vector<std::string>& names,
                          std::vector<Material>& materials) {
  std::map<std::size_t, ObjectChange> said;
  for (const ObjectChange& change : changes) {
    ObjectChange& all = said[find_object(change.object, names)];
    for (const auto& [key, value] : change.values) all.values[key] = value;
  }
  for (const auto& [object, change] : said) {
    Material& material = materials[object];
    apply(Part::preset, change, material);
    const Material before = material;
    apply(Part::phong, change, material);
    follow_change(before, material);
    apply(Part::gltf, change, material);
  }
}

std::vector<ObjectChange> object_changes_between(const std::vector<Material>& loaded,
                                                 const std::vector<Material>& shown,
                                                 const std::vector<std::string>& names) {
  assert(loaded.size() == shown.size() && names.size() == shown.size());
  std::vector<ObjectChange> changes;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    Material from = loaded[i];
    ObjectChange change{object_key(i, names)};
    add_difference(Part::phong, from, shown[i], change);
    apply(Part::phong, change, from);
    follow_change(loaded[i], from);
    add_difference(Part::gltf, from, shown[i], change);
    if (!change.values.empty()) changes.push_back(std::move(change));
  }
  return changes;
}

}  // namespace splatray
