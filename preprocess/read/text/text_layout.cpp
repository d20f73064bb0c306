#include "preprocess/read/text/text_layout.h"

#include <algorithm>
#include <cmath>

#include "engine/base/utf8.h"
#include "preprocess/base/quoted_list.h"
#include "preprocess/read/byte_reader.h"
#include "preprocess/read/scan/column_names.h"
#include "preprocess/read/text/parse_number.h"

namespace splatray {
namespace {

constexpr std::size_t MOST_LINE_BYTES = ByteReader::BLOCK_BYTES;
constexpr std::uint64_t MOST_HEAD_LINES = 100000;  ///< of comments

std::string_view trimmed(std::string_view text, std::string_view blanks = " \t\r\"") {
  const std::size_t begin = std::min(text.find_first_not_of(blanks), text.size());
  return text.substr(begin, text.find_last_not_of(blanks) + 1 - begin);
}

std::vector<std::string> split(std::string_view line, char separator) {
  std::vector<std::string> cells;
  const std::string_view ends =
      separator == ' ' ? std::string_view(" \t\r") : std::string_view(&separator, 1);
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find_first_of(ends, begin), line.size());
    const std::string_view cell = trimmed(line.substr(begin, end - begin));
    if (separator != ' ' || !cell.empty()) cells.push_back(to_utf8(cell));
    begin = end + 1;
  }
  return cells;
}

bool is_number(std::string cell, bool decimal_comma) {
  if (decimal_comma) std::replace(cell.begin(), cell.end(), ',', '.');
  double value = 0.0;
  const char* const end = cell.data() + cell.size();
  return cell.empty() || parse_number(cell.data(), end, value) == end;
}

/// Tabs count where each stands between cells of one word; else they are blanks among others.
char separator_of(std::string_view line, bool names) {
  if (line.find(';') != std::string_view::npos) return ';';
  if (line.find('\t') != std::string_view::npos) {
    const std::vector<std::string> cells = split(line, '\t');
    const bool words = std::none_of(cells.begin(), cells.end(), [](const std::string& cell) {
      return cell.find(' ') != std::string::npos;
    });
    if (words || names) return '\t';
  }
  return line.find(',') != std::string_view::npos ? ',' : ' ';
}

class HeadReader {
 public:
  HeadReader(const std::filesystem::path& path, const ScanOptions& options)
      : path_(path), options_(options), in_(path) {}

  TextLayout read() {
    if (!options_.columns.empty()) name_by_list();
    for (std::string_view line; layout_.data.lines < MOST_HEAD_LINES && in_.line(line, MOST_LINE_BYTES);) {
      if (is_first_row(line)) break;
      ++layout_.data.lines;
      layout_.data.offset = in_.offset();
    }
    finish();
    return std::move(layout_);
  }

 private:
  /// Whether the points begin here; takes in what the line says otherwise.
  bool is_first_row(std::string_view line) {
    const std::string_view text = trimmed(line, " \t\r");
    if (text.empty()) return false;
    if (text.front() == '#' || text.starts_with("//")) {
      name_by_comment(text);
      return false;
    }
    layout_.form.separator = separator_of(line, false);
    layout_.form.decimal_comma = layout_.form.separator == ';' || layout_.form.separator == '\t';
    const std::vector<std::string> cells = split(line, layout_.form.separator);
    if (cells.size() == 1 && !layout_.count && is_count(cells[0])) return false;
    if (is_row(cells)) return true;
    if (named_) return !by_list_ || header_seen_;  // the rows' own reader says what is wrong with it
    header_seen_ = true;
    if (by_list_) return false;
    name_by_header(line);
    return false;
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

  bool is_row(const std::vector<std::string>& cells) const {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const bool used =
          layout_.columns.empty() || (i < layout_.columns.size() && !layout_.columns[i].empty());
      if (used && !is_number(cells[i], layout_.form.decimal_comma)) return false;
    }
    return true;
  }

  void name_by_list() {
    const std::vector<std::string> names = split(options_.columns, ',');
    name(names, true);
    if (!has_axes())
      throw_unreadable(
          path_, "found the columns '" + options_.columns + "' asked for, expected x, y and z among them");
    named_ = by_list_ = true;
  }

  void name_by_header(std::string_view line) {
    const std::vector<std::string> names = split(line, separator_of(line, true));
    name(names, false);
    if (!has_axes())
      throw_unreadable(path_, "line " + std::to_string(layout_.data.lines + 1) + ": found " +
                                  quoted_list(names) +
                                  ", expected numbers, or names of columns with x, y and z among them");
    named_ = true;
  }

  /// Names stand in comments too; those without x, y and z are words.
  void name_by_comment(std::string_view text) {
    if (named_) return;
    const std::string_view words = trimmed(text, "#/ \t\r");
    name(split(words, separator_of(words, true)), false);
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
