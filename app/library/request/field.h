/// One thing that can be asked for: its name in every door, its text, and its description for users.
#pragma once
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "app/library/request/request.h"
#include "app/library/request/value_text.h"
#include "engine/base/nearest_name.h"
#include "engine/base/number_text.h"
#include "engine/base/utf8.h"

namespace splatray {

/// Parts of the help, in its order.
enum class FieldGroup { input, look, light, camera, region, sheet, quality, output, files, research };
/// "Input" and so on.
[[nodiscard]] const char* group_title(FieldGroup group);

/// What a field's value is for doors that have types: JSON and Python.
enum class FieldKind {
  flag,    ///< on or off; of a command line the name alone is on
  number,  ///< floating-point
  whole,   ///< a whole number
  text,    ///< anything else, as text
};

/// The doors that have a field, a bit each.
using FieldDoors = unsigned;
inline constexpr FieldDoors DOOR_PREPROCESS = 1;  ///< splatray-preprocess
inline constexpr FieldDoors DOOR_RENDER = 2;      ///< splatray-render
inline constexpr FieldDoors DOOR_VIEW = 4;        ///< splatray-view: its command line and its panels
inline constexpr FieldDoors DOOR_LIBRARY = 8;     ///< C++ and Python
inline constexpr FieldDoors DOORS_OF_PICTURES = DOOR_RENDER | DOOR_VIEW | DOOR_LIBRARY;
inline constexpr FieldDoors DOORS_ALL = DOORS_OF_PICTURES | DOOR_PREPROCESS;

/// What a field is beside a part of the help, a bit each.
using FieldTraits = unsigned;
inline constexpr FieldTraits OF_FILES = 1;      ///< how pictures are made for their files, not what is seen
inline constexpr FieldTraits OF_SEQUENCES = 2;  ///< of several pictures alone
/// The viewer's dialogs have a control of their own for it.
inline constexpr FieldTraits HAS_OWN_CONTROL = 4;
/// Decides neither a sample's light nor which scene and pixels it is of.
inline constexpr FieldTraits NOT_OF_LIGHT = 8;
/// How a scene is read, made and first shown: the library's open() takes it.
inline constexpr FieldTraits OF_SCENES = 16;
/// The library's render() takes it, too: as it does all that is of the groups from look to research and not OF_SCENES.
inline constexpr FieldTraits OF_PICTURES = 32;

/// A field's name and a value of it, as text.
struct FieldText {
  std::string name, text;
  bool operator==(const FieldText&) const = default;
};

struct Field {
  std::string name;  ///< "radius-scale"; of a command line with -- before it, in Python with _ for -
  FieldGroup group = FieldGroup::input;
  FieldKind kind = FieldKind::text;
  /// What stands for the value in help, such as "X,Y,Z"; of a choice its names with | between; of a switch nothing.
  std::string value;
  std::string help;                    ///< what it is, its unit, range and default
  std::vector<std::string> choices{};  ///< names of which it is one; empty for other fields
  /// Reads a value; throws Expected for another text, and Error of what a file in it says.
  std::function<void(Request&, const std::string&)> read;
  /// The value as texts that read() accepts, each with its field's name, as those of a family are written together; empty if unset.
  /// Empty function: it has no text of its own.
  std::function<std::vector<FieldText>(const Request&)> write;
  FieldDoors doors = DOORS_OF_PICTURES;
  std::string why_not;  ///< why the other doors do not have it; empty where all that make pictures do
  std::vector<std::string> old_names{};  ///< names of before, which command lines still take
  std::string letter{};                  ///< of a command line: "-o"
  bool repeated = false;                 ///< each value given counts; else the last
  std::string family{};  ///< repeated fields whose values keep one order; empty = its own name
  std::function<void(Request&)> clear{};  ///< of repeated ones: takes out the values of the family
  bool adds = false;  ///< of repeated ones: values go behind those there were, instead of taking their place
  double least = 0.0, most = 0.0;  ///< of numbers
  std::string brief{};  ///< what it is, in a few words, where most people need it: the short help shows it
  std::string extensions{};  ///< of files that are read: with dots, a blank between; empty: any
  char between = ',';        ///< what stands between the parts of a value, which JSON may have as an array
  FieldTraits traits = 0;
  unsigned looks = ~0U;  ///< that use it: a bit for each LOOK_*

  [[nodiscard]] const std::string& family_name() const { return family.empty() ? name : family; }
  /// The field with traits beside those that it has.
  [[nodiscard]] Field marked(FieldTraits more) const;
  /// The field as one that only these looks (LOOK_*) use.
  [[nodiscard]] Field of_looks(std::initializer_list<std::uint32_t> users) const;
  [[nodiscard]] bool in(FieldDoors door) const { return (doors & door) != 0; }
  [[nodiscard]] bool is(FieldTraits trait) const { return (traits & trait) != 0; }
  [[nodiscard]] bool used_by(std::uint32_t look) const { return (looks >> look & 1U) != 0; }
};

/// Another name, old ones, other doors: what a row says beside its kind.
struct FieldExtras {
  FieldDoors doors = DOORS_OF_PICTURES;
  std::string why_not{};
  std::vector<std::string> old_names{};
  std::string letter{};
};
[[nodiscard]] Field with(Field field, FieldExtras extras);
/// One that most people need.
[[nodiscard]] Field needed(Field field, std::string brief);

/// A member of a request, for the kinds of rows: MEMBER(view.width).
#define MEMBER(path) \
  [](auto& request) -> auto& { return request.path; }

// Kinds of rows.

/// With a read and a write of its own. `write` gives an empty text where the value is unset.
[[nodiscard]] Field value_row(std::string name, FieldGroup group, std::string value, std::string help,
                              std::function<void(Request&, const std::string&)> read,
                              std::function<std::string(const Request&)> write);

[[nodiscard]] std::string text_of(double value);
[[nodiscard]] std::string text_of(float value);
[[nodiscard]] std::string text_of(std::uint64_t value);
[[nodiscard]] inline std::string text_of(std::uint32_t value) { return text_of(std::uint64_t{value}); }

/// A number in [least, most].
template <class Member>
[[nodiscard]] Field number_row(std::string name, FieldGroup group, Member member, double least, double most,
                               std::string help) {
  using Number = std::remove_cvref_t<decltype(member(std::declval<Request&>()))>;
  constexpr bool WHOLE = !std::is_floating_point_v<Number>;
  Field row = value_row(
      std::move(name), group, WHOLE ? "N" : "X", std::move(help),
      [=](Request& request, const std::string& text) {
        member(request) = static_cast<Number>(read_number(text, least, most, WHOLE));
      },
      [=](const Request& request) { return text_of(member(request)); });
  row.kind = WHOLE ? FieldKind::whole : FieldKind::number;
  row.least = least;
  row.most = most;
  return row;
}

/// A number in [least, most], least > 0, that need not be said: the request then has 0.
template <class Member>
[[nodiscard]] Field unset_number_row(std::string name, FieldGroup group, Member member, double least,
                                     double most, std::string help) {
  Field row = number_row(std::move(name), group, member, least, most, std::move(help));
  row.write = [=, write = row.write](const Request& request) {
    return member(request) == 0 ? std::vector<FieldText>{} : write(request);
  };
  return row;
}

/// On or off; a switch of command lines.
template <class Member>
[[nodiscard]] Field switch_row(std::string name, FieldGroup group, Member member, std::string help) {
  Field row = value_row(
      std::move(name), group, "", std::move(help),
      [=](Request& request, const std::string& text) {
        if (text != "on" && text != "off") throw Expected{"on or off"};
        member(request) = text == "on";
      },
      [=](const Request& request) -> std::string { return member(request) ? "on" : "off"; });
  row.kind = FieldKind::flag;
  return row;
}

/// One of a few names.
template <class Value, class Member>
[[nodiscard]] Field choice_row(std::string name, FieldGroup group, Member member,
                               std::vector<Choice<Value>> choices, std::string help) {
  std::string names;
  for (const Choice<Value>& choice : choices) names += (names.empty() ? "" : "|") + choice.name;
  Field row = value_row(
      std::move(name), group, names, std::move(help),
      [=](Request& request, const std::string& text) {
        for (const Choice<Value>& choice : choices)
          if (text == choice.name) return void(member(request) = choice.value);
        std::vector<std::string> all;
        for (const Choice<Value>& choice : choices) all.push_back(choice.name);
        throw Expected{"one of " + names + did_you_mean(text, all)};
      },
      [=](const Request& request) -> std::string {
        for (const Choice<Value>& choice : choices)
          if (member(request) == choice.value) return choice.name;
        return "";
      });
  for (const Choice<Value>& choice : choices) row.choices.push_back(choice.name);
  return row;
}

/// on or off, where a command line says which: what is on by default.
template <class Member>
[[nodiscard]] Field on_off_row(std::string name, FieldGroup group, Member member, std::string help) {
  Field row = switch_row(std::move(name), group, member, std::move(help));
  row.value = "on|off";
  return row;
}

/// Any text, as UTF-8.
template <class Member>
[[nodiscard]] Field text_row(std::string name, FieldGroup group, Member member, std::string help,
                             std::string value) {
  return value_row(
      std::move(name), group, std::move(value), std::move(help),
      [=](Request& request, const std::string& text) { member(request) = to_utf8(text); },
      [=](const Request& request) { return std::string(member(request)); });
}

/// A file or folder.
template <class Member>
[[nodiscard]] Field path_row(std::string name, FieldGroup group, Member member, std::string help) {
  return value_row(
      std::move(name), group, "FILE", std::move(help),
      [=](Request& request, const std::string& text) { member(request) = text; },
      [=](const Request& request) { return member(request).string(); });
}

/// Three numbers, or nothing.
template <class Member>
[[nodiscard]] Field vector_row(std::string name, FieldGroup group, Member member, std::string help) {
  return value_row(
      std::move(name), group, "X,Y,Z", std::move(help),
      [=](Request& request, const std::string& text) { member(request) = read_vector(text); },
      [=](const Request& request) { return member(request) ? number_text(*member(request)) : ""; });
}

/// Files or folders; all that are given take the place of those there were.
template <class Member>
[[nodiscard]] Field paths_row(std::string name, FieldGroup group, Member member, std::string help,
                              std::string value) {
  Field row =
      value_row(name, group, std::move(value), std::move(help),
                [=](Request& request, const std::string& text) { member(request).emplace_back(text); }, {});
  row.repeated = true;
  row.clear = [=](Request& request) { member(request).clear(); };
  row.write = [=](const Request& request) {
    std::vector<FieldText> texts;
    for (const std::filesystem::path& path : member(request)) texts.push_back({name, path.string()});
    return texts;
  };
  return row;
}

}  // namespace splatray
