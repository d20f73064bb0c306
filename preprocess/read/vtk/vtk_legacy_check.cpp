#include "preprocess/read/vtk/vtk_legacy_check.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "preprocess/base/lower_case.h"
#include "preprocess/read/bytes/byte_reader.h"

namespace splatray {
namespace {

constexpr std::size_t MOST_LINE = 256;  // bytes, VTK's own limit

/// Bits of a value in binary files. VTK writes vtkIdType as int there.
const std::map<std::string_view, std::uint64_t> TYPE_BITS{
    {"bit", 1},           {"char", 8},           {"signed_char", 8},
    {"unsigned_char", 8}, {"short", 16},         {"unsigned_short", 16},
    {"int", 32},          {"unsigned_int", 32},  {"vtkidtype", 32},
    {"float", 32},        {"long", 64},          {"unsigned_long", 64},
    {"vtktypeint64", 64}, {"vtktypeuint64", 64}, {"double", 64},
};

class LegacyScan {
 public:
  LegacyScan(const std::filesystem::path& path, const ReadListener& listener)
      : in_(path, &listener), size_(in_.remaining()) {}

  void scan() {
    read_header();
    for (std::string key = lower_case(next_word()); !key.empty(); key = lower_case(next_word())) {
      const auto section = SECTIONS.find(key);
      if (section == SECTIONS.end())
        fail("found '" + key.substr(0, 40) + "', expected a section of a VTK file, such as POINTS");
      section->second(*this);
    }
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw_unreadable(in_.path(), what); }

  int next() {
    const unsigned char* byte = in_.take(1);
    return byte == nullptr ? -1 : *byte;
  }

  /// What stands up to the next blank, which is taken too; empty at the file's end.
  std::string next_word() {
    int c = next();
    while (c >= 0 && std::isspace(c) != 0) c = next();
    std::string word;
    for (; c >= 0 && std::isspace(c) == 0; c = next()) {
      if (word.size() >= MOST_LINE) fail("found a word of more than 256 bytes");
      word += static_cast<char>(c);
    }
    line_ended_ = c == '\n' || c < 0;
    return word;
  }

  /// The rest of a line.
  std::string rest_of_line() {
    std::string line;
    for (int c = line_ended_ ? '\n' : next(); c >= 0 && c != '\n'; c = next()) {
      if (line.size() >= MOST_LINE && line.find('\r') != std::string::npos) refuse_cr();
      if (line.size() >= MOST_LINE) fail("found a line of more than 256 bytes");
      line += static_cast<char>(c);
    }
    line_ended_ = true;
    return line;
  }

  /// VTK reads lines that end in LF alone.
  std::string first_line() {
    const std::string line = rest_of_line();
    const std::size_t end = line.find('\r');
    if (end != std::string::npos && end + 1 < line.size()) refuse_cr();
    return line;
  }

  [[noreturn]] void refuse_cr() const { fail("found lines that end in CR, expected LF or CR LF"); }

  std::uint64_t number_of(const std::string& word, const char* what) const {
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (word.empty() || error != std::errc{} || end != word.data() + word.size())
      fail("found " + std::string(what) + " '" + word.substr(0, 20) + "', expected a whole number");
    if (number > size_)
      fail("found " + std::string(what) + " " + word + ", expected one that fits a file of " +
           std::to_string(size_) + " bytes");
    return number;
  }

  std::uint64_t next_number(const char* what) { return number_of(next_word(), what); }

  void read_header() {
    line_ended_ = false;
    constexpr std::string_view BEGIN = "# vtk DataFile Version ";
    if (in_.begin_text(); in_.offset() > 0)
      fail("found a byte order mark before '# vtk', expected none: save it as UTF-8 without one");
    const std::string first = first_line();
    const std::size_t dot = first.find('.');
    if (!first.starts_with(BEGIN) || dot == std::string::npos)
      fail("found no '# vtk DataFile Version 5.1' or the like, expected it as the first line");
    lists_cells_ = number_of(first.substr(BEGIN.size(), dot - BEGIN.size()), "version") < 5;
    line_ended_ = false;
    static_cast<void>(rest_of_line());  // the title
    const std::string coding = lower_case(next_word());
    if (coding != "ascii" && coding != "binary")
      fail("found '" + coding.substr(0, 20) + "', expected ASCII or BINARY");
    binary_ = coding == "binary";
  }

  /// Passes an array of `tuples` times `width` values.
  void skip_values(std::uint64_t tuples, std::uint64_t width, const std::string& type) {
    const auto known = TYPE_BITS.find(lower_case(type));
    if (known == TYPE_BITS.end())
      fail("found values of type '" + type.substr(0, 20) + "', expected numbers such as float");
    if (width > 0 && tuples > 8 * size_ / width) fail_beyond(tuples, width);
    const std::uint64_t values = tuples * width;
    if (binary_) {
      static_cast<void>(rest_of_line());
      if (!in_.skip((values * known->second + 7) / 8)) fail_beyond(tuples, width);
      line_ended_ = false;
      return;
    }
    for (std::uint64_t i = 0; i < values; ++i)
      if (next_word().empty()) fail_beyond(tuples, width);
  }

  [[noreturn]] void fail_beyond(std::uint64_t tuples, std::uint64_t width) const {
    fail("found an array of " + std::to_string(tuples) + " times " + std::to_string(width) +
         " values, expected it within the file");
  }

  void skip_points() {
    const std::uint64_t count = next_number("number of points");
    skip_values(count, 3, next_word());
  }

  void skip_axis() {
    const std::uint64_t count = next_number("number of coordinates");
    skip_values(count, 1, next_word());
  }

  void skip_dimensions() {
    std::uint64_t product = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const std::uint64_t count = next_number("dimension");
      if (count > 0 && product > 8 * size_ / count)
        fail("found dimensions of more points than fit a file of " + std::to_string(size_) + " bytes");
      product *= count;
    }
  }

  void skip_three() {
    for (int axis = 0; axis < 3; ++axis)
      if (next_word().empty()) fail("found its end within three numbers");
  }

  /// Cells: offsets and connectivity, or, in files before version 5, a list of counts, each followed by that many numbers.
  void skip_cells() {
    const std::uint64_t count = next_number("number of cells");
    const std::uint64_t size = next_number("size of the list of cells");
    if (lists_cells_) return check_list(count, size);
    if (count == 0) return;
    for (const auto& [word, values] : {std::pair("offsets", count), {"connectivity", size}}) {
      const std::string found = lower_case(next_word());
      if (found != word) fail("found '" + found.substr(0, 20) + "', expected " + word);
      skip_values(values, 1, next_word());
    }
  }

  std::uint64_t next_count() {
    if (!binary_) return next_number("number of a cell's points");
    std::uint64_t number = 0;
    for (int byte = 0; byte < 4; ++byte) {
      const int c = next();
      if (c < 0) fail("found its end within the list of cells");
      number = number << 8U | static_cast<unsigned>(c);
    }
    return number;
  }

  void check_list(std::uint64_t count, std::uint64_t size) {
    if (binary_) static_cast<void>(rest_of_line());
    std::uint64_t passed = 0;
    for (std::uint64_t cell = 0; cell < count; ++cell) {
      const std::uint64_t points = next_count();
      passed += 1 + points;
      if (points > size || passed > size)
        fail("found a cell of " + std::to_string(points) + " points, expected it within a list of " +
             std::to_string(size) + " numbers");
      if (binary_ && !in_.skip(4 * points)) fail("found its end within the list of cells");
      for (std::uint64_t i = 0; i < points && !binary_; ++i) check_vertex(next_word());
    }
    if (passed != size)
      fail("found cells of " + std::to_string(passed) + " numbers, expected " + std::to_string(size));
    line_ended_ = false;
  }

  /// Checks a cell in text: VTK's reader goes on without a file where it finds no int.
  void check_vertex(const std::string& word) const {
    if (word.empty()) fail("found its end within the list of cells");
    if (number_of(word, "vertex") > std::numeric_limits<int>::max())
      fail("found vertex " + word + ", expected a number that VTK's lists of cells hold");
  }

  void skip_cell_types() { skip_values(next_number("number of cell types"), 1, "int"); }

  void skip_scalars() {
    static_cast<void>(next_word());  // name
    const std::string type = next_word();
    const std::string more = rest_of_line();
    const std::size_t digit = more.find_first_not_of(" \t\r");
    const std::uint64_t width =
        digit == std::string::npos ? 1
                                   : number_of(more.substr(digit, more.find_first_of(" \t\r", digit) - digit),
                                               "number of components");
    if (lower_case(next_word()) != "lookup_table") fail("found scalars without LOOKUP_TABLE, expected it");
    static_cast<void>(next_word());
    skip_values(values_, width, type);
  }

  void skip_colors() {
    static_cast<void>(next_word());
    skip_values(values_, next_number("number of components"), binary_ ? "unsigned_char" : "float");
  }

  void skip_lookup_table() {
    static_cast<void>(next_word());
    skip_values(next_number("size of a table"), 4, binary_ ? "unsigned_char" : "float");
  }

  void skip_texture_coordinates() {
    static_cast<void>(next_word());
    const std::uint64_t width = next_number("number of components");
    skip_values(values_, width, next_word());
  }

  template <std::uint64_t width>
  void skip_attribute() {
    static_cast<void>(next_word());
    skip_values(values_, width, next_word());
  }

  void skip_field() {
    static_cast<void>(next_word());
    const std::uint64_t arrays = next_number("number of arrays");
    for (std::uint64_t i = 0; i < arrays; ++i) {
      std::string name = next_word();
      if (lower_case(name) == "metadata") {
        skip_metadata();
        name = next_word();
      }
      if (lower_case(name) == "null_array") continue;
      const std::uint64_t width = next_number("number of components");
      const std::uint64_t tuples = next_number("number of tuples");
      skip_values(tuples, width, next_word());
    }
  }

  /// Lines up to an empty one.
  void skip_metadata() {
    static_cast<void>(rest_of_line());
    for (bool more = true; more && in_.remaining() > 0;) {
      line_ended_ = false;
      more = rest_of_line().find_first_not_of(" \t\r") != std::string::npos;
    }
  }

  void read_kind() {
    const std::string kind = lower_case(next_word());
    constexpr std::array<std::string_view, 4> KINDS{"polydata", "unstructured_grid", "structured_grid",
                                                    "rectilinear_grid"};
    if (std::find(KINDS.begin(), KINDS.end(), kind) == KINDS.end())
      fail("found a dataset '" + kind.substr(0, 40) +
           "', expected POLYDATA, UNSTRUCTURED_GRID, STRUCTURED_GRID or RECTILINEAR_GRID");
  }

  using Section = std::function<void(LegacyScan&)>;
  static const std::map<std::string_view, Section> SECTIONS;

  ByteReader in_;
  std::uint64_t size_;
  bool binary_ = false;
  bool lists_cells_ = false;  ///< as versions before 5 do
  bool line_ended_ = false;   ///< the last word ended its line
  std::uint64_t values_ = 0;  ///< of each attribute: the number of points or cells
};

const std::map<std::string_view, LegacyScan::Section> LegacyScan::SECTIONS{
    {"dataset", &LegacyScan::read_kind},
    {"points", &LegacyScan::skip_points},
    {"dimensions", &LegacyScan::skip_dimensions},
    {"spacing", &LegacyScan::skip_three},
    {"aspect_ratio", &LegacyScan::skip_three},
    {"origin", &LegacyScan::skip_three},
    {"x_coordinates", &LegacyScan::skip_axis},
    {"y_coordinates", &LegacyScan::skip_axis},
    {"z_coordinates", &LegacyScan::skip_axis},
    {"vertices", &LegacyScan::skip_cells},
    {"lines", &LegacyScan::skip_cells},
    {"polygons", &LegacyScan::skip_cells},
    {"triangle_strips", &LegacyScan::skip_cells},
    {"cells", &LegacyScan::skip_cells},
    {"cell_types", &LegacyScan::skip_cell_types},
    {"point_data", [](LegacyScan& scan) { scan.values_ = scan.next_number("number of points' values"); }},
    {"cell_data", [](LegacyScan& scan) { scan.values_ = scan.next_number("number of cells' values"); }},
    {"scalars", &LegacyScan::skip_scalars},
    {"color_scalars", &LegacyScan::skip_colors},
    {"lookup_table", &LegacyScan::skip_lookup_table},
    {"texture_coordinates", &LegacyScan::skip_texture_coordinates},
    {"vectors", &LegacyScan::skip_attribute<3>},
    {"normals", &LegacyScan::skip_attribute<3>},
    {"tensors", &LegacyScan::skip_attribute<9>},
    {"tensors6", &LegacyScan::skip_attribute<6>},
    {"global_ids", &LegacyScan::skip_attribute<1>},
    {"pedigree_ids", &LegacyScan::skip_attribute<1>},
    {"edge_flags", &LegacyScan::skip_attribute<1>},
    {"field", &LegacyScan::skip_field},
    {"metadata", &LegacyScan::skip_metadata},
};

}  // namespace

void check_vtk_legacy(const std::filesystem::path& path, const ReadListener& listener) {
  LegacyScan(path, listener).scan();
}

}  // namespace splatray
