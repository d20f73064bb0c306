#include "preprocess/read/text/text_layout.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "preprocess/base/quoted_list.h"
#include "preprocess/read/bytes/byte_reader.h"
#include "preprocess/read/scan/column_names.h"
#include "preprocess/read/text/next_word.h"
#include "preprocess/read/text/parse_number.h"

namespace splatray {
namespace {

constexpr std::size_t MOST_ROW_BYTES = ByteReader::BLOCK_BYTES;
constexpr std::uint64_t MOST_HEAD_LINES = 100000;  ///< of comments

/// The separator of a line of names: tabs part names of several words.
char separator_of_names(std::string_view line) {
  const char separator = find_cell_form({std::string(line)}).separator;
  const bool has_tab = line.find('\t') != std::string_view::npos;
  return has_tab && separator != ';' ? '\t' : separator;
}

/// Whether cells count the rows, with x, y and z behind: at least three from 0 or 1 on, or as many as are looked at from any
/// number on.
bool count_rows(const std::vector<std::string>& rows, const CellForm& form) {
  const bool starts_anywhere = rows.size() == CellForm::MOST_ROWS;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::vector<std::string> cells = split_cells(rows[i], form.separator);
    double number = NAN;
    double first = NAN;
    const bool are_numbers = cells.size() > 3 && parse_cell(cells[0], form, number) &&
                             parse_cell(split_cells(rows[0], form.separator)[0], form, first);
    if (!are_numbers || (!starts_anywhere && first != 0.0 && first != 1.0) ||
        number != std::floor(first) + static_cast<double>(i))
      return false;
  }
  return rows.size() >= 3;
}

/// Whether these are rows of COLMAP's points3D.txt, whose names stand in comments that people cut off: a number, x y z, colours
/// of 8 bits, an error, then pairs of an image and a point in it.
bool are_colmap_rows(const std::vector<std::string>& rows, const CellForm& form) {
  const auto is_whole = [](double value, double most) {
    return value >= 0.0 && value <= most && value == std::floor(value);
  };
  for (const std::string& row : rows) {
    const std::vector<std::string> cells = split_cells(row, form.separator);
    if (cells.size() < 8 || cells.size() % 2 != 0) return false;
    std::array<double, 8> values{};
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!parse_cell(cells[i], form, values[i])) return false;
    const bool is_point = is_whole(values[0], 1e18) && is_whole(values[4], 255.0) &&
                          is_whole(values[5], 255.0) && is_whole(values[6], 255.0) && values[7] >= 0.0;
    if (!is_point) return false;
  }
  return true;
}

class HeadReader {
 public:
  HeadReader(const std::filesystem::path& path, const ScanOptions& options)
      : path_(path), options_(options), in_(path) {}

  TextLayout read() {
    if (!options_.columns.empty()) name_by_list();
    for (std::string_view line; layout_.data.lines < MOST_HEAD_LINES && in_.line(line, MOST_ROW_BYTES);) {
      if (is_first_row(line)) {
        take_rows(std::string(line));
        break;
      }
      ++layout_.data.lines;
      layout_.data.offset = in_.offset();
    }
    finish();
    return std::move(layout_);
  }

 private:
  /// Whether the points begin here; takes in what the line says otherwise.
  bool is_first_row(std::string_view line) {
    const std::string_view text = without_blanks(line, " \t\r");
    if (text.empty()) return false;
    if (is_remark(text)) {
      name_by_comment(text);
      return false;
    }
    const CellForm form = find_cell_form({std::string(line)});
    const std::vector<std::string> cells = split_cells(line, form.separator);
    if (cells.size() == 1 && !layout_.count && is_count(cells[0])) return false;
    if (is_row(cells, form)) return true;
    if (named_) return !by_list_ || header_seen_;  // the rows' own reader says what is wrong with it
    header_seen_ = true;
    if (by_list_) return false;
    name_by_header(line);
    return false;
  }

  /// The rows from the first on, which say what their form is.
  void take_rows(std::string first) {
    const std::vector<std::string> rows = first_rows(in_, {std::move(first)});
    layout_.form = find_cell_form(rows);
    if (!named_ && plain_name(path_.stem().string()) == "points3d" && are_colmap_rows(rows, layout_.form)) {
      name({"-", "x", "y", "z", "red", "green", "blue"}, false);
      named_ = true;
    }
    layout_.numbered = !named_ && count_rows(rows, layout_.form);
    if (named_) check_cells(split_cells(rows[0], layout_.form.separator).size());
  }

  /// Numbers with decimal commas between commas make twice the cells.
  void check_cells(std::size_t cells) {
    const std::size_t names = layout_.columns.size();
    layout_.has_more = cells > names;
    if (layout_.form.separator == ',' && !by_list_ && cells >= 2 * names)
      throw_unreadable(
          path_,
          "line " + std::to_string(layout_.data.lines + 1) + ": found " + std::to_string(cells) +
              " cells under " + std::to_string(names) +
              " names, expected as many: numbers with decimal commas need quotes or another separator");
  }

  bool is_count(const std::string& cell) {
    double value = NAN;
    const char* const end = cell.data() + cell.size();
    if (parse_number(cell.data(), end, value) != end || !(value >= 0.0 && value < 1e15) ||
        value != std::floor(value))
      return false;
    layout_.count = static_cast<std::uint64_t>(value);
    return true;
  }

  bool is_row(const std::vector<std::string>& cells, const CellForm& form) const {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const bool used =
          layout_.columns.empty() || (i < layout_.columns.size() && !layout_.columns[i].empty());
      double value = NAN;
      if (used && !parse_cell(cells[i], form, value)) return false;
    }
    return true;
  }

  void name_by_list() {
    const std::vector<std::string> names = split_cells(options_.columns, ',');
    name(names, true);
    if (!has_axes())
      throw_unreadable(
          path_, "found the columns '" + options_.columns + "' asked for, expected x, y and z among them");
    named_ = by_list_ = true;
  }

  void name_by_header(std::string_view line) {
    const std::vector<std::string> names = split_cells(line, separator_of_names(line));
    name(names, false);
    if (!has_axes())
      throw_unreadable(path_,
                       "line " + std::to_string(layout_.data.lines + 1) + ": found " + quoted_list(names) +
                           ", expected numbers, or names of columns with x, y and z among them (--columns "
                           "gives names)");
    named_ = true;
  }

  /// Names stand in comments too; those without x, y and z are words.
  void name_by_comment(std::string_view text) {
    if (named_) return;
    const std::string_view words = without_blanks(text, "#/ \t\r");
    name(split_cells(words, separator_of_names(words)), false);
    named_ = has_axes();
    if (!named_) name({}, false);
  }

  void name(const std::vector<std::string>& names, bool keep_all) {
    layout_.columns = known_columns(names);
    layout_.unused.clear();
    layout_.degrees = false;
    for (std::size_t i = 0; i < names.size(); ++i) {
      std::string& column = layout_.columns[i];
      layout_.degrees = layout_.degrees || (!column.empty() && is_degrees(names[i]));
      if (column.empty() && plain_name(names[i]) == COLUMN_RADIUS) column = COLUMN_RADIUS;
      if (column.empty()) column = attribute(names[i], keep_all);
      if (column.empty() && names[i] != "-") layout_.unused.push_back(names[i]);
    }
  }

  /// The name to keep a column under that is not a known one; "" = it is not wanted.
  std::string attribute(const std::string& name, bool keep_all) const {
    for (const std::string& wanted : options_.attributes)
      if (!name.empty() && plain_name(wanted) == plain_name(name)) return wanted;
    return keep_all && name != "-" ? name : "";
  }

  [[nodiscard]] bool has_axes() const {
    const std::vector<std::string>& columns = layout_.columns;
    return std::all_of(std::begin(COLUMN_AXES), std::end(COLUMN_AXES), [&](std::string_view axis) {
      return std::find(columns.begin(), columns.end(), axis) != columns.end();
    });
  }

  void finish() {
    if (!named_) return;
    for (const std::string& column : layout_.columns) layout_.form.skipped.push_back(column.empty());
    layout_.form.has_more = true;
  }

  const std::filesystem::path& path_;
  const ScanOptions& options_;
  ByteReader in_;
  TextLayout layout_;
  bool named_ = false;
  bool by_list_ = false;
  bool header_seen_ = false;
};

}  // namespace

TextLayout find_text_layout(const std::filesystem::path& path, const ScanOptions& options) {
  return HeadReader(path, options).read();
}

}  // namespace splatray
