#include "app/library/sheet/measure_table.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/library/sheet/page_style.h"
#include "app/library/sheet/text_block.h"

namespace splatray {
namespace {

// Millimetres.
constexpr double CELL_PAD = 0.8, BETWEEN_TABLES = 4.0, NAME_LEAST = 8.0;

enum TableColumn : std::size_t { NUMBER, NAME, KIND, VALUE, WITHIN, UNIT, COLUMNS };
using Row = std::array<std::string, COLUMNS>;
constexpr bool is_number(std::size_t column) {
  return column == NUMBER || column == VALUE || column == WITHIN;
}

/// Header and rows.
std::vector<Row> table_rows(std::span<const MeasureRow> rows) {
  std::vector<Row> all = {{"No.", "Name", "Kind", "Value", "\u00B1 (95 %)", "Unit"}};
  std::size_t last = 0;
  for (const MeasureRow& row : rows) {
    const bool has_all =
        row.kind == measure_name(MeasureKind::point) || row.kind == measure_name(MeasureKind::volume);
    const bool is_main = row.id != last;
    last = row.id;
    if (has_all || is_main)
      all.push_back({std::to_string(row.id), row.name, has_all ? row.kind + ", " + row.quantity : row.kind,
                     row.words.value, row.words.within, row.words.unit});
  }
  return all;
}

using Widths = std::array<double, COLUMNS>;

double sum_of(const Widths& widths) {
  double sum = 0.0;
  for (const double width : widths) sum += width;
  return sum;
}

/// As wide as the widest text of each column; names get what is left of the width.
Widths widths_of(const std::vector<Row>& rows, double width_mm) {
  Widths widths{};
  for (const Row& row : rows)
    for (std::size_t i = 0; i < COLUMNS; ++i)
      widths[i] = std::max(widths[i], text_width(row[i], LABEL_SIZE_MM) + 2.0 * CELL_PAD);
  const double others = sum_of(widths) - widths[NAME];
  widths[NAME] = std::min(widths[NAME], std::max(width_mm - others, NAME_LEAST));
  return widths;
}

/// Adds a row below what the table has.
void add_row(const Row& row, const Widths& widths, Drawing& table) {
  const double top = table.size.y + CELL_PAD, line = line_height(LABEL_SIZE_MM);
  double height = line, left = 0.0;
  for (std::size_t i = 0; i < COLUMNS; ++i) {
    const double room = widths[i] - 2.0 * CELL_PAD + 1e-6;
    const double before = is_number(i) ? room - text_width(row[i], LABEL_SIZE_MM) : 0.0;
    height = std::max(height, add_text(row[i], LABEL_SIZE_MM, room, {left + CELL_PAD + before, top}, table));
    left += widths[i];
  }
  table.size.y = top + height + CELL_PAD;
  table.lines.push_back({{0.0, table.size.y}, {left, table.size.y}, FINE_LINE_MM});
}

}  // namespace

Drawing measure_table(std::span<const MeasureRow> measures, double width_mm) {
  Drawing all;
  if (measures.empty()) return all;
  const std::vector<Row> rows = table_rows(measures);
  const Widths widths = widths_of(rows, width_mm);
  const double width = sum_of(widths), step = width + BETWEEN_TABLES;
  const std::size_t count = rows.size() - 1;
  const auto room =
      static_cast<std::size_t>(std::max(std::floor((width_mm + BETWEEN_TABLES) / step + 1e-9), 1.0));
  const std::size_t tables = std::min(room, count), each = (count + tables - 1) / tables;
  for (std::size_t first = 1; first < rows.size(); first += each) {
    Drawing table;
    table.size.x = width;
    table.lines.push_back({{0.0, 0.0}, {width, 0.0}, FINE_LINE_MM});
    add_row(rows[0], widths, table);
    for (std::size_t i = first; i < std::min(first + each, rows.size()); ++i) add_row(rows[i], widths, table);
    add_block(table, {static_cast<double>((first - 1) / each) * step, 0.0}, all);
    all.size = glm::max(all.size, glm::dvec2(0.0, table.size.y));
  }
  all.size.x = std::max(width_mm, width);
  return all;
}

}  // namespace splatray
