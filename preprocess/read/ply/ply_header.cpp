#include "preprocess/read/ply/ply_header.h"

#include <algorithm>
#include <charconv>
#include <sstream>
#include <utility>

#include "engine/base/utf8.h"
#include "preprocess/base/lower_case.h"

namespace splatray {
namespace {

constexpr std::size_t MAX_HEADER_LINE_BYTES = 65536;
constexpr std::uint64_t MAX_HEADER_BYTES = std::uint64_t{1} << 20U;

PlyType type_of(const std::string& name) {
  static const std::pair<const char*, PlyType> NAMES[] = {
      {"char", PlyType::int8},        {"int8", PlyType::int8},       {"byte", PlyType::int8},
      {"uchar", PlyType::uint8},      {"uint8", PlyType::uint8},     {"ubyte", PlyType::uint8},
      {"bool", PlyType::uint8},       {"boolean", PlyType::uint8},   {"short", PlyType::int16},
      {"int16", PlyType::int16},      {"ushort", PlyType::uint16},   {"uint16", PlyType::uint16},
      {"int", PlyType::int32},        {"int32", PlyType::int32},     {"uint", PlyType::uint32},
      {"uint32", PlyType::uint32},    {"long", PlyType::int64},      {"int64", PlyType::int64},
      {"longlong", PlyType::int64},   {"ulong", PlyType::uint64},    {"uint64", PlyType::uint64},
      {"ulonglong", PlyType::uint64}, {"half", PlyType::float16},    {"float16", PlyType::float16},
      {"float", PlyType::float32},    {"float32", PlyType::float32}, {"double", PlyType::float64},
      {"float64", PlyType::float64},
  };
  for (const auto& [known, type] : NAMES) {
    if (name == known) {
      return type;
    }
  }
  return PlyType::other;
}

bool is_integer(PlyType type) { return type < PlyType::float16; }

class PlyHeaderParser {
 public:
  explicit PlyHeaderParser(ByteReader& in) : in_(in) {}

  PlyHeader parse() {
    if (lower_case(next_line()) != "ply") {
      throw_unreadable(in_.path(), "the first line is not 'ply', expected a PLY file");
    }
    bool format_seen = false;
    for (;;) {
      std::istringstream words(next_line());
      std::string key;
      words >> key;
      key = lower_case(key);
      if (key == "end_header") {
        break;
      }
      if (key == "format") {
        parse_format(words);
        format_seen = true;
      } else if (key == "element") {
        parse_element(words);
      } else if (key == "property") {
        parse_property(words);
      } else if (key == "comment" || key == "obj_info") {
        std::string remark;
        std::getline(words, remark);
        header_.remarks.push_back(std::move(remark));
      } else if (!key.empty()) {
        fail("found '" + key.substr(0, 40) + "', expected format, element, property, comment or end_header");
      }
    }
    if (!format_seen) {
      fail("the header ends without a 'format' line");
    }
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw_unreadable(in_.path(), "line " + std::to_string(header_.line_count) + ": " + what);
  }

  std::string next_line() {
    std::string_view text;
    if (in_.offset() > MAX_HEADER_BYTES || !in_.line(text, MAX_HEADER_LINE_BYTES)) {
      fail("the header has no 'end_header' line");
    }
    ++header_.line_count;
    return to_utf8(text);
  }

  void parse_format(std::istringstream& words) {
    std::string format;
    std::string version;
    words >> format >> version;
    format = lower_case(format);
    if (!header_.elements.empty()) fail("found the format behind an element, expected it before the first");
    if (format == "ascii") {
      header_.format = PlyFormat::ascii;
    } else if (format == "binary_little_endian") {
      header_.format = PlyFormat::binary_little_endian;
    } else if (format == "binary_big_endian") {
      header_.format = PlyFormat::binary_big_endian;
    } else {
      fail("found format '" + format.substr(0, 40) +
           "', expected ascii, binary_little_endian or binary_big_endian");
    }
    if (version != "1.0") {
      fail("found PLY version '" + version.substr(0, 40) + "', expected 1.0");
    }
  }

  void parse_element(std::istringstream& words) {
    PlyElement element;
    std::string count;
    words >> element.name >> count;
    element.name = lower_case(element.name);
    const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (element.name.empty() || count.empty() || error != std::errc{} || end != count.data() + count.size()) {
      fail("found the count '" + count.substr(0, 40) + "' of element '" + element.name.substr(0, 40) +
           "', expected a whole number");
    }
    header_.elements.push_back(std::move(element));
  }

  PlyType parse_type(std::istringstream& words) {
    std::string name;
    words >> name;
    const PlyType type = type_of(lower_case(name));
    if (type == PlyType::other && header_.format != PlyFormat::ascii) {
      fail("found property type '" + name.substr(0, 40) + "', expected char to double or int8 to float64");
    }
    return type;
  }

  void parse_property(std::istringstream& words) {
    if (header_.elements.empty()) {
      fail("a property stands before the first element");
    }
    PlyProperty property;
    const std::istringstream::pos_type start = words.tellg();
    std::string kind;
    words >> kind;
    property.is_list = lower_case(kind) == "list";
    if (property.is_list) {
      property.count_type = parse_type(words);
      if (!is_integer(property.count_type)) {
        fail("a list's length is no integer, expected an integer type");
      }
    } else {
      words.clear();
      words.seekg(start);
    }
    property.type = parse_type(words);
    words >> property.name;
    if (property.name.empty()) {
      fail("a property has no name");
    }
    header_.elements.back().properties.push_back(std::move(property));
  }

  ByteReader& in_;
  PlyHeader header_;
};

}  // namespace

std::size_t ply_type_bytes(PlyType type) {
  static constexpr std::size_t BYTES[] = {1, 1, 2, 2, 4, 4, 8, 8, 2, 4, 8, 0};
  return BYTES[static_cast<std::size_t>(type)];
}

std::uint64_t PlyElement::min_row_bytes(PlyFormat format) const {
  std::uint64_t bytes = 0;
  for (const PlyProperty& property : properties) {
    const PlyType type = property.is_list ? property.count_type : property.type;
    bytes += format == PlyFormat::ascii ? 2 : ply_type_bytes(type);
  }
  return bytes;
}

int PlyElement::find(const std::string& property) const {
  const auto index_of = [&](const auto& is_it) {
    const auto found = std::find_if(properties.begin(), properties.end(), is_it);
    return found == properties.end() ? -1 : static_cast<int>(found - properties.begin());
  };
  const int same = index_of([&](const PlyProperty& one) { return one.name == property; });
  return same >= 0
             ? same
             : index_of([&](const PlyProperty& one) { return lower_case(one.name) == lower_case(property); });
}

PlyHeader read_ply_header(ByteReader& in) { return PlyHeaderParser(in).parse(); }

}  // namespace splatray
