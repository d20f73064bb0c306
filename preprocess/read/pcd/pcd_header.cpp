#include "preprocess/read/pcd/pcd_header.h"

#include "engine/base/utf8.h"
#include "preprocess/base/lower_case.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <optional>
#include <sstream>
#include <utility>

namespace splatray {
namespace {

constexpr std::size_t MOST_PCD_LINE_BYTES = 65536;
constexpr std::uint64_t MOST_LINES = 1000;
constexpr std::size_t MOST_FIELDS = 1000;

using Words = std::vector<std::string>;

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

template <typename Number>
std::optional<Number> number_of(const std::string& word) {
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  const bool whole = error == std::errc{} && end == word.data() + word.size();
  return whole ? std::optional(value) : std::nullopt;
}

std::optional<PcdType> type_of(const std::string& kind, std::uint32_t size) {
  struct Row {
    const char* kind;
    std::uint32_t size;
    PcdType type;
  };
  static constexpr Row ROWS[] = {
      {"I", 1, PcdType::int8},    {"U", 1, PcdType::uint8},  {"I", 2, PcdType::int16},
      {"U", 2, PcdType::uint16},  {"I", 4, PcdType::int32},  {"U", 4, PcdType::uint32},
      {"I", 8, PcdType::int64},   {"U", 8, PcdType::uint64}, {"F", 4, PcdType::float32},
      {"F", 8, PcdType::float64},
  };
  for (const Row& row : ROWS)
    if (kind == row.kind && size == row.size) return row.type;
  return std::nullopt;
}

class PcdHeaderParser {
 public:
  explicit PcdHeaderParser(ByteReader& in) : in_(in) {}

  PcdHeader parse() {
    for (std::string_view line; header_.line_count < MOST_LINES && in_.line(line, MOST_PCD_LINE_BYTES);) {
      ++header_.line_count;
      std::istringstream stream{to_utf8(line)};
      Words words{std::istream_iterator<std::string>(stream), {}};
      if (words.empty() || words[0].front() == '#') continue;
      const std::string key = upper(words[0]);
      words.erase(words.begin());
      read_line(key, words);
      if (key == "DATA") return finished();
    }
    fail("the header has no DATA line, expected a PCD file");
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw_unreadable(in_.path(), "line " + std::to_string(header_.line_count) + ": " + what);
  }

  void read_line(const std::string& key, const Words& words) {
    if (key == "FIELDS" || key == "COLUMNS") {
      names_ = words;
    } else if (key == "SIZE") {
      sizes_ = words;
    } else if (key == "TYPE") {
      types_ = words;
    } else if (key == "COUNT") {
      counts_ = words;
    } else if (key == "WIDTH") {
      header_.width = whole<std::uint32_t>(key, words);
    } else if (key == "HEIGHT") {
      header_.height = whole<std::uint32_t>(key, words);
    } else if (key == "POINTS") {
      points_ = whole<std::uint64_t>(key, words);
    } else if (key == "VIEWPOINT") {
      read_viewpoint(words);
    } else if (key == "DATA") {
      read_data(words);
    } else if (key != "VERSION") {
      fail("found '" + key.substr(0, 40) + "', expected a word of PCD's header such as FIELDS, SIZE or DATA");
    }
  }

  template <typename Number>
  Number whole(const std::string& key, const Words& words) const {
    const std::optional<Number> value = words.size() == 1 ? number_of<Number>(words[0]) : std::nullopt;
    if (!value) fail("found no whole number for " + key + ", expected one");
    return *value;
  }

  void read_viewpoint(const Words& words) {
    double values[7] = {};
    bool is_whole = words.size() == 7;
    for (std::size_t i = 0; i < 7 && is_whole; ++i) {
      const std::optional<double> value = number_of<double>(words[i]);
      is_whole = value && std::isfinite(*value);
      values[i] = value.value_or(0.0);
    }
    const glm::dvec4 rotation(values[3], values[4], values[5], values[6]);
    header_.is_viewpoint_left_out = !is_whole || rotation == glm::dvec4(0.0);
    if (header_.is_viewpoint_left_out) return;
    header_.viewpoint = {values[0], values[1], values[2]};
    header_.rotation = rotation;
  }

  void read_data(const Words& words) {
    const std::string kind = words.size() == 1 ? lower_case(words[0]) : "";
    if (kind == "ascii") {
      header_.data = PcdData::ascii;
    } else if (kind == "binary") {
      header_.data = PcdData::binary;
    } else if (kind == "binary_compressed") {
      header_.data = PcdData::binary_compressed;
    } else {
      fail("found DATA '" + kind.substr(0, 40) + "', expected ascii, binary or binary_compressed");
    }
  }

  PcdHeader finished() {
    if (counts_.empty()) counts_.assign(names_.size(), "1");
    if (names_.empty() || names_.size() > MOST_FIELDS || sizes_.size() != names_.size() ||
        types_.size() != names_.size() || counts_.size() != names_.size())
      fail("found " + std::to_string(names_.size()) + " FIELDS, " + std::to_string(sizes_.size()) +
           " SIZEs, " + std::to_string(types_.size()) + " TYPEs and " + std::to_string(counts_.size()) +
           " COUNTs, expected equally many, 1 to 1000");
    for (std::size_t i = 0; i < names_.size(); ++i) add_field(i);
    header_.points = points_.value_or(std::uint64_t{header_.width} * header_.height);
    if (header_.width == 1) std::swap(header_.width, header_.height);
    return std::move(header_);
  }

  void add_field(std::size_t i) {
    PcdField field;
    field.name = names_[i];
    const auto size = number_of<std::uint32_t>(sizes_[i]);
    const auto count = number_of<std::uint32_t>(counts_[i]);
    const auto type = size ? type_of(upper(types_[i]), *size) : std::nullopt;
    if (!type || !count)
      fail("found TYPE '" + types_[i].substr(0, 20) + "', SIZE '" + sizes_[i].substr(0, 20) +
           "' and COUNT '" + counts_[i].substr(0, 20) + "' of field '" + field.name.substr(0, 40) +
           "', expected I or U of 1, 2, 4 or 8 bytes, or F of 4 or 8, and a whole number");
    field.type = *type;
    field.size = *size;
    field.count = *count;
    field.offset = header_.row_bytes;
    field.cell = header_.row_cells;
    header_.row_bytes += field.bytes();
    header_.row_cells += field.count;
    if (header_.row_bytes > ByteReader::BLOCK_BYTES)
      fail("found points of " + std::to_string(header_.row_bytes) + " bytes, expected at most " +
           std::to_string(ByteReader::BLOCK_BYTES));
    header_.fields.push_back(std::move(field));
  }

  ByteReader& in_;
  PcdHeader header_;
  Words names_;
  Words sizes_;
  Words types_;
  Words counts_;
  std::optional<std::uint64_t> points_;
};

}  // namespace

const PcdField* PcdHeader::find(std::string_view name) const {
  const std::string wanted = lower_case(std::string(name));
  for (const PcdField& field : fields)
    if (field.count == 1 && lower_case(field.name) == wanted) return &field;
  return nullptr;
}

PcdHeader read_pcd_header(ByteReader& in) { return PcdHeaderParser(in).parse(); }

}  // namespace splatray
