#include "app/library/request/request_json.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "app/library/codec/json_file.h"
#include "app/library/request/fields.h"
#include "engine/base/error.h"
#include "engine/base/number_text.h"
#include "engine/file/file_roles.h"

namespace splatray {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uintmax_t MOST_BYTES = 1U << 24U;

/// A value that is not repeated.
Json typed(const Field& field, const std::string& text) {
  if (field.kind == FieldKind::flag) return text == "on";
  if (field.kind == FieldKind::whole) return static_cast<std::uint64_t>(std::stoull(text));
  if (field.kind == FieldKind::number) return split_numbers(text, ',', 1).front();
  return text;
}

/// The text of a value in JSON; nothing of an object, array or null.
std::optional<std::string> text_of(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "on" : "off";
  if (value.is_number_unsigned()) return std::to_string(value.get<std::uint64_t>());
  if (value.is_number_integer()) return std::to_string(value.get<std::int64_t>());
  if (value.is_number()) return number_text(value.get<double>());
  return {};
}

bool is_numbers(const Json& value) {
  return value.is_array() && !value.empty() &&
         std::all_of(value.begin(), value.end(), [](const Json& part) { return part.is_number(); });
}

/// The values of a repeated field: those of an array, or one alone, which may be an array of numbers.
Json in_a_list(const Json& value) {
  return value.is_array() && !is_numbers(value) ? value : Json::array({value});
}

/// The fields of a family, in which the texts of an array begin with the field's name where it has several.
std::vector<const Field*> family(const std::string& name) {
  std::vector<const Field*> found;
  for (const Field& field : fields())
    if (field.repeated && field.family_name() == name) found.push_back(&field);
  return found;
}

class Reader {
 public:
  explicit Reader(std::string source) : source_(std::move(source)) {}

  [[noreturn]] void refuse(const std::string& found, const std::string& expected) const {
    throw Error(ExitCode::input_unreadable,
                "cannot read the request in " + source_ + ": found " + found + ", expected " + expected);
  }

  [[nodiscard]] std::vector<FieldText> read(const Json& json) const {
    if (!json.is_object()) refuse("no object", "{\"inputs\": [\"scan.laz\"], ...}");
    std::vector<FieldText> values;
    for (const auto& [name, value] : json.items()) {
      const Field* field = find_field(name, DOORS_ALL);
      if (const std::vector<const Field*> members = family(name); !members.empty())
        read_family(name, members, value, values);
      else if (field != nullptr && field->repeated)  // one kind of a family, such as "sun"
        for (const Json& one : in_a_list(value)) values.push_back({name, text(name, one)});
      else
        values.push_back({name, text(name, value)});
    }
    return values;
  }

 private:
  /// A value's text; an array is the parts of one.
  [[nodiscard]] std::string text(const std::string& name, const Json& value, char between) const {
    if (value.is_array() && !value.empty()) {
      std::string whole;
      for (const Json& part : value) {
        const std::optional<std::string> one = text_of(part);
        if (!one) refuse("'" + name + "' of an array of " + part.type_name(), "numbers or texts in it");
        whole += (whole.empty() ? "" : std::string(1, between)) + *one;
      }
      return whole;
    }
    const std::optional<std::string> found = text_of(value);
    if (!found)
      refuse("'" + name + "' of " + (value.is_array() ? "an empty array" : value.type_name()),
             "a number, true, false, a text or an array of such");
    return *found;
  }

  [[nodiscard]] std::string text(const std::string& name, const Json& value) const {
    const Field* field = find_field(name, DOORS_ALL);
    return text(name, value, field == nullptr ? ',' : field->between);
  }

  void read_family(const std::string& name, const std::vector<const Field*>& members, const Json& list,
                   std::vector<FieldText>& values) const {
    if (list.empty() && list.is_array() && name == "lights") values.push_back({"lights", "none"});
    for (const Json& value : in_a_list(list)) {
      const std::string whole = text(name, value);
      if (members.size() == 1) {
        values.push_back({name, whole});
        continue;
      }
      const std::size_t equals = std::min(whole.find('='), whole.size());
      const std::string kind = whole.substr(0, equals);
      const bool known = std::any_of(members.begin(), members.end(),
                                     [&](const Field* field) { return field->name == kind; });
      if (!known || equals == whole.size()) refuse("'" + whole + "' in '" + name + "'", "such as sun=0,-1,1");
      values.push_back({kind, whole.substr(equals + 1)});
    }
  }

  std::string source_;
};

}  // namespace

std::string request_json(const Request& request, int indent) {
  Json json = Json::object();
  for (const FieldText& value : changed_values(request)) {
    const Field& field = *find_field(value.name, DOORS_ALL);
    if (!field.repeated) {
      json[value.name] = typed(field, value.text);
      continue;
    }
    const bool several = family(field.family_name()).size() > 1;
    Json& list = json[field.family_name()];
    if (list.is_null()) list = Json::array();
    if (value != FieldText{"lights", "none"})
      list.push_back(several ? value.name + "=" + value.text : value.text);
  }
  try {
    return json.dump(indent) + (indent < 0 ? "" : "\n");
  } catch (const Json::type_error&) {
    throw Error(ExitCode::usage,
                "found a text that is no UTF-8 in a request, expected names that JSON can hold");
  }
}

Request read_request_text(const std::string& text, const std::string& source) {
  const Reader reader(source);
  const Json json = parse_json(text, [&reader](const std::string& found, const std::string&) {
    reader.refuse(found, "an object of names and values");
  });
  Request request;
  try {
    assign(request, reader.read(json), DOORS_ALL);
  } catch (const Error& error) {
    if (error.code() != ExitCode::usage) throw;
    throw Error(ExitCode::input_unreadable, "cannot read the request in " + source + ": " + error.what());
  }
  return request;
}

Request read_request(const std::filesystem::path& path) {
  const std::string source = "'" + path.string() + "'";
  std::error_code error;
  if (const auto bytes = std::filesystem::file_size(path, error); error || bytes > MOST_BYTES)
    Reader(source).refuse(error ? error.message() : "more than 16 MiB", "a file of JSON");
  note_input(path);
  std::ifstream file(path, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(file)), {});
  if (!file) Reader(source).refuse("a file that cannot be read", "a file of JSON");
  return read_request_text(text, source);
}

}  // namespace splatray
