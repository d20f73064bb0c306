/// What is wrong with a text that should be JSON, in our words. All that reads JSON says it so.
#pragma once
#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/json_depth.h"
#include "engine/base/one_line.h"

namespace splatray {

/// "line 3, column 7": where a byte of a text stands, both counted from 1, columns in bytes.
[[nodiscard]] inline std::string place_in_text(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, byte);
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const std::size_t begin = before.rfind('\n') + 1;  // 0 where there is none
  return "line " + std::to_string(line) + ", column " + std::to_string(before.size() - begin + 1);
}

/// Hears what a parser of nlohmann's library finds, and keeps the first thing that is wrong.
template <class Json>
class JsonFaults {
 public:
  explicit JsonFaults(std::string_view text) : text_(text) {}

  bool null() { return true; }
  bool boolean(bool) { return true; }
  bool number_integer(typename Json::number_integer_t) { return true; }
  bool number_unsigned(typename Json::number_unsigned_t) { return true; }
  bool number_float(typename Json::number_float_t, const std::string&) { return true; }
  bool string(const std::string&) { return true; }
  bool binary(const typename Json::binary_t&) { return true; }
  bool start_array(std::size_t) { return true; }
  bool end_array() { return true; }
  bool start_object(std::size_t) {
    names_.emplace_back();
    return true;
  }
  bool key(const std::string& name) {
    if (names_.back().insert(name).second) return true;
    fault_ = "'" + one_line(name) + "' twice in one object";
    return false;
  }
  bool end_object() {
    names_.pop_back();
    return true;
  }
  /// `position` counts the bytes up to what the parser stumbles over.
  template <class Exception>
  bool parse_error(std::size_t position, const std::string&, const Exception& exception) {
    constexpr int OUT_OF_RANGE = 406;  // the library's number for what float64 cannot hold
    const std::size_t last = text_.find_last_not_of(" \t\r\n");
    const std::size_t byte = position > 0 ? position - 1 : 0;
    if (exception.id == OUT_OF_RANGE)
      fault_ = "a number beyond float64 at " + place_in_text(text_, byte);
    else if (last == std::string_view::npos)
      fault_ = "no JSON, but an empty text";
    else if (byte > last)
      fault_ = "JSON that ends in its middle, at " + place_in_text(text_, last + 1);
    else
      fault_ = "no JSON at " + place_in_text(text_, byte);
    return false;
  }

  [[nodiscard]] const std::optional<std::string>& fault() const { return fault_; }

 private:
  std::string_view text_;
  std::vector<std::set<std::string>> names_;  ///< of each object that is open
  std::optional<std::string> fault_;
};

/// The first thing that keeps a text from being JSON whose objects have each name once, such as "no JSON at line 3, column 7";
/// nothing where it is. `Json`: nlohmann's library.
template <class Json>
[[nodiscard]] std::optional<std::string> json_fault(std::string_view text) {
  if (json_is_too_deep(text)) return "JSON that nests more than " + std::to_string(MOST_JSON_DEPTH) + " deep";
  JsonFaults<Json> faults(text);
  static_cast<void>(Json::sax_parse(text.begin(), text.end(), &faults));
  return faults.fault();
}

}  // namespace splatray
