#include "preprocess/read/text/cell_form.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <utility>

#include "engine/base/utf8.h"
#include "preprocess/read/bytes/byte_reader.h"
#include "preprocess/read/text/next_word.h"
#include "preprocess/read/text/parse_number.h"

namespace splatray {
namespace {

constexpr std::string_view MISSING[] = {"null", "nan",     "na",      "n/a", "#n/a", "none",
                                        "nil",  "no data", "missing", "?",   "\\n"};

bool is_missing(std::string_view cell) {
  const auto is_it = [&](std::string_view word) {
    return std::equal(cell.begin(), cell.end(), word.begin(), word.end(),
                      [](unsigned char a, char b) { return std::tolower(a) == b; });
  };
  return cell.empty() || std::any_of(std::begin(MISSING), std::end(MISSING), is_it);
}

bool is_whole_number(std::string_view text, double& value) {
  return !text.empty() &&
         parse_number(text.data(), text.data() + text.size(), value) == text.data() + text.size();
}

/// Takes the marks out between groups of three digits, of which the first may be shorter; false where they part no such.
bool join_groups(std::string_view whole, char mark, std::string& digits) {
  std::size_t length = 0;
  bool is_first = true;
  for (const char c : whole) {
    if (c == mark) {
      if (length == 0 || length > 3 || (!is_first && length != 3)) return false;
      length = 0;
      is_first = false;
    } else if (std::isdigit(static_cast<unsigned char>(c)) != 0) {
      digits += c;
      ++length;
    } else {
      return false;
    }
  }
  return !is_first && length == 3;
}

/// Reads digits in groups of three, with or without a decimal point behind them.
bool parse_groups(std::string_view cell, double& value) {
  std::string digits;
  if (!cell.empty() && (cell.front() == '-' || cell.front() == '+')) {
    if (cell.front() == '-') digits += '-';
    cell.remove_prefix(1);
  }
  const std::size_t first = cell.find_first_of(",.' ");
  if (first == std::string_view::npos) return false;
  const char mark = cell[first];
  const std::size_t last = cell.find_last_of(",.' ");
  const bool has_point = cell[last] == '.' && last != first;
  if (!join_groups(cell.substr(0, has_point ? last : cell.size()), mark, digits)) return false;
  if (has_point) digits += cell.substr(last);
  return is_whole_number(digits, value);
}

/// What a cell's commas can be.
enum class Commas { none, neither, groups, decimal, either };

Commas commas_of(std::string_view cell) {
  if (cell.find(',') == std::string_view::npos) return Commas::none;
  if (cell.front() == ',' || cell.back() == ',') return Commas::neither;
  double value = 0.0;
  const bool groups = parse_groups(cell, value);
  std::string pointed(cell);
  std::replace(pointed.begin(), pointed.end(), ',', '.');
  const bool is_last = cell.find('.', cell.rfind(',')) == std::string_view::npos;
  const bool decimal = is_last && (is_whole_number(pointed, value) || parse_groups(pointed, value));
  if (groups && decimal) return Commas::either;
  return groups ? Commas::groups : decimal ? Commas::decimal : Commas::neither;
}

/// What the commas are in all cells together.
Commas commas_of(const std::vector<std::string>& cells) {
  bool seen[5] = {};
  for (const std::string& cell : cells) seen[static_cast<std::size_t>(commas_of(cell))] = true;
  for (const Commas one : {Commas::neither, Commas::groups, Commas::decimal, Commas::either})
    if (seen[static_cast<std::size_t>(one)]) return one;
  return Commas::none;
}

std::vector<std::string> all_cells(const std::vector<std::string>& rows, char separator) {
  std::vector<std::string> cells;
  for (const std::string& row : rows) {
    std::vector<std::string> more = split_cells(row, separator);
    cells.insert(cells.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  }
  return cells;
}

/// Tabs count where each stands between cells of one word; else they are blanks among others.
bool is_tabbed(const std::string& row) {
  if (row.find('\t') == std::string::npos) return false;
  const std::vector<std::string> cells = split_cells(row, '\t');
  return std::none_of(cells.begin(), cells.end(),
                      [](const std::string& cell) { return cell.find(' ') != std::string::npos; });
}

/// Whether blanks separate at least three cells of each row with commas, and these stand within numbers.
bool is_blank_separated(const std::vector<std::string>& rows) {
  return std::all_of(rows.begin(), rows.end(), [](const std::string& row) {
    const std::vector<std::string> cells = split_cells(row, ' ');
    const bool has_comma = row.find(',') != std::string::npos;
    return !has_comma || (cells.size() >= 3 && commas_of(cells) != Commas::neither);
  });
}

}  // namespace

std::vector<std::string> split_cells(std::string_view line, char separator) {
  std::vector<std::string> cells;
  const char* const end = line.data() + line.size();
  for (const char* begin = line.data();; ++begin) {
    const char* const cell_end =
        separator == ' ' ? std::find_if(begin, end, is_blank) : end_of_cell(begin, end, separator);
    const std::string_view cell = without_blanks({begin, static_cast<std::size_t>(cell_end - begin)});
    if (separator != ' ' || !cell.empty()) cells.push_back(to_utf8(cell));
    if (cell_end == end) return cells;
    begin = cell_end;
  }
}

const char* end_of_cell(const char* begin, const char* end, char separator) {
  const char* const first = std::find_if_not(begin, end, is_blank);
  if (first != end && *first == '"') {
    const char* const closed = std::find(first + 1, end, '"');
    if (closed != end) return std::find(closed, end, separator);
  }
  return std::find(begin, end, separator);
}

bool parse_cell(std::string_view cell, const CellForm& form, double& value) {
  value = NAN;
  cell = without_blanks(cell);
  if (is_missing(cell)) return true;
  std::string text(cell);
  if (form.decimal_comma) std::replace(text.begin(), text.end(), ',', '.');
  if (is_whole_number(text, value) || parse_groups(text, value)) return true;
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == 'D' || c == 'd'; }, 'e');  // Fortran's exponents
  return is_whole_number(text, value);
}

bool is_remark(std::string_view line) {
  const std::string_view text = without_blanks(line, " \t\r");
  return text.empty() || text.front() == '#' || text.starts_with("//");
}

CellForm find_cell_form(const std::vector<std::string>& rows) {
  const auto any_has = [&](char c) {
    return std::any_of(rows.begin(), rows.end(),
                       [c](const std::string& row) { return row.find(c) != std::string::npos; });
  };
  CellForm form;
  if (any_has(';')) {
    form.separator = ';';
  } else if (!rows.empty() && std::all_of(rows.begin(), rows.end(), is_tabbed)) {
    form.separator = '\t';
  } else if (any_has(',') && !is_blank_separated(rows)) {
    form.separator = ',';
  }
  std::vector<std::string> cells = all_cells(rows, form.separator);
  std::erase_if(cells, [](const std::string& cell) { return commas_of(cell) == Commas::neither; });  // words
  const Commas commas = commas_of(cells);
  const bool is_sure =
      form.separator == ',' || form.separator == ' ';  // others leave no other use for commas
  form.decimal_comma = is_sure
                           ? commas == Commas::decimal || (commas == Commas::either && form.separator == ' ')
                           : commas != Commas::groups;
  return form;
}

std::vector<std::string> first_rows(ByteReader& in, std::vector<std::string> rows) {
  for (std::string_view line; rows.size() < CellForm::MOST_ROWS && in.line(line, ByteReader::BLOCK_BYTES);)
    if (!is_remark(line)) rows.emplace_back(line);
  if (rows.size() > 1 && in.line_is_open()) rows.pop_back();  // it may have been cut
  return rows;
}

CellForm form_of_rows(const std::filesystem::path& path) {
  ByteReader in(path);
  return find_cell_form(first_rows(in));
}

}  // namespace splatray
