/// How lines of numbers are split into cells: the one finder of all text formats of points.
#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace splatray {

class ByteReader;

/// How a line is split into cells.
struct CellForm {
  /// That decide: commas of millimetres are groups of three digits in few rows alone.
  static constexpr std::size_t MOST_ROWS = 64;

  char separator = ' ';  ///< ' ' = any number of blanks and tabs; any other ends a cell, which may be empty
  bool decimal_comma = false;  ///< 1,5 is one and a half; beside the separator ',' in quotes
  std::vector<bool> skipped;   ///< cells, by number, that are not read; those beyond it are
  bool has_more = false;       ///< cells beyond `skipped` are none of the row, and not read
};

/// The cells of a line, without blanks and quotes around them; separators in quotes end none.
[[nodiscard]] std::vector<std::string> split_cells(std::string_view line, char separator);

/// The first character behind the cell that begins at `begin`; `separator` is not a blank.
[[nodiscard]] const char* end_of_cell(const char* begin, const char* end, char separator);

/// Reads a cell that is more than a number between blanks: quotes around it, exponents of Fortran (1D3), digits in groups of three (1,234.5, 1'234,
/// 1.234,5 where commas are decimal ones), NaN for what is empty or a word for "missing" (NULL, N/A, NaN, none, ?). Whether
/// it is one of these.
[[nodiscard]] bool parse_cell(std::string_view cell, const CellForm& form, double& value);

/// Whether a line is a comment (# or //) or empty.
[[nodiscard]] bool is_remark(std::string_view line);

/// The separator of these rows and what their commas are. Separators are semicolons, tabs with a word between each two,
/// commas, else blanks. Commas are decimal ones between digits where something else separates, unless a point follows them
/// or they part groups of three digits throughout, and in quotes where they part no such groups.
[[nodiscard]] CellForm find_cell_form(const std::vector<std::string>& rows);

/// The first of the rows from here on that are no remarks, at most CellForm::MOST_ROWS, behind those of `rows`.
[[nodiscard]] std::vector<std::string> first_rows(ByteReader& in, std::vector<std::string> rows = {});

/// The form of a file's first rows.
[[nodiscard]] CellForm form_of_rows(const std::filesystem::path& path);

}  // namespace splatray
