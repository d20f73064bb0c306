#include "app/library/sheet/page_blocks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "app/library/sheet/height_marks.h"
#include "app/library/sheet/measure_table.h"
#include "app/library/sheet/page_style.h"
#include "app/library/sheet/sheet_view.h"
#include "app/library/sheet/text_block.h"
#include "engine/base/crs.h"
#include "engine/base/number_text.h"
#include "engine/base/srgb.h"
#include "engine/scene/splat.h"

namespace splatray {
namespace {

// Millimetres.
constexpr double KEY_SIZE = 1.8, TITLE_SIZE = 4.5;
constexpr double PAD = 1.2, KEY_GAP = 4.0;
constexpr double NORTH_LINE = 0.35;
constexpr double BAR_MOST = 60.0, BAR_HEIGHT = 1.6, BAR_BESIDE = 0.8;
constexpr double NORTH_WIDTH = 5.0, NORTH_HEIGHT = 12.0, NORTH_HEAD = 4.0;
constexpr double RAMP_MOST = 60.0, RAMP_HEIGHT = 3.0, SWATCH = 3.0, SWATCH_BESIDE = 1.5;
constexpr int RAMP_BOXES = 60;
constexpr double RAMP_TOLD_APART = 0.1;  ///< of a ramp's span

/// A field of the title block.
struct Cell {
  const char* key;
  std::string text;
  double size_mm = TEXT_SIZE_MM;
};

/// Cells side by side, each as high as the highest.
Drawing cell_row(const std::vector<Cell>& cells, double width_mm) {
  Drawing row;
  const double width = width_mm / static_cast<double>(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const glm::dvec2 corner(static_cast<double>(i) * width + PAD, PAD);
    const double room = width - 2.0 * PAD;
    const double key = add_text(cells[i].key, KEY_SIZE, room, corner, row);
    const double text = add_text(cells[i].text, cells[i].size_mm, room, corner + glm::dvec2(0.0, key), row);
    row.size.y = std::max(row.size.y, key + text + 2.0 * PAD);
  }
  row.size.x = width_mm;
  for (std::size_t i = 1; i < cells.size(); ++i) {
    const double x = static_cast<double>(i) * width;
    row.lines.push_back({{x, 0.0}, {x, row.size.y}, CELL_LINE_MM});
  }
  return row;
}

std::string system_text(const Sheet& sheet) {
  if (!sheet.north_up) return "along the paper and upwards";
  const std::string name = describe_crs(sheet.crs).name;
  return name.empty() ? "of the file, not named" : name;
}

/// Where one stands who sees an elevation, "the south".
std::string side_text(double degrees) {
  static constexpr std::array SIDES = {"the north", "the east", "the south", "the west"};
  for (std::size_t i = 0; i < SIDES.size(); ++i)
    if (degrees == 90.0 * static_cast<double>(i)) return SIDES[i];
  return number_text(degrees) + "\u00B0 clockwise from north";
}

/// Four parts of a round length, in turn filled.
Drawing bar_block(const Sheet& sheet, double width_mm) {
  Drawing block;
  const double label = line_height(LABEL_SIZE_MM);
  const double length = round_length(std::min(BAR_MOST, 0.5 * width_mm) * sheet.mm_world(), Rounding::down);
  const double part = length / sheet.mm_world() / 4.0;
  const std::string end_text = length_text(sheet, length);
  const double zero = 0.5 * text_width("0", LABEL_SIZE_MM), end_width = text_width(end_text, LABEL_SIZE_MM);
  // The end's text stands behind the middle of a bar that is shorter than it.
  const double end = std::max(zero + 4.0 * part, 2.0 * zero + BAR_BESIDE + 0.5 * end_width);
  const double top = label + BAR_BESIDE;
  for (int i = 0; i < 4; ++i) {
    const glm::dvec2 begin(zero + i * part, top), last(begin.x + part, top + BAR_HEIGHT);
    if (i % 2 == 0) block.boxes.push_back({begin, last - begin});
    block.lines.push_back({begin, {last.x, begin.y}, FINE_LINE_MM});
    block.lines.push_back({{begin.x, last.y}, last, FINE_LINE_MM});
    block.lines.push_back({{last.x, begin.y}, last, FINE_LINE_MM});
  }
  block.lines.push_back({{zero, top}, {zero, top + BAR_HEIGHT}, FINE_LINE_MM});
  const double base = 0.8 * label;
  block.texts.push_back({{zero, base}, LABEL_SIZE_MM, TextAnchor::middle, "0"});
  block.texts.push_back({{end, base}, LABEL_SIZE_MM, TextAnchor::middle, end_text});
  block.size = {end + 0.5 * end_width, top + BAR_HEIGHT};
  return block;
}

Drawing north_block() {
  Drawing block;
  const double letter = line_height(TEXT_SIZE_MM), middle = 0.5 * NORTH_WIDTH;
  const glm::dvec2 tip(middle, letter), foot(middle, letter + NORTH_HEIGHT);
  block.texts.push_back({{middle, 0.8 * letter}, TEXT_SIZE_MM, TextAnchor::middle, "N"});
  block.lines.push_back({foot, tip, NORTH_LINE});
  for (const double side : {-1.0, 1.0})
    block.lines.push_back({tip, tip + glm::dvec2(side * 1.8, NORTH_HEAD), NORTH_LINE});
  block.size = {NORTH_WIDTH, foot.y};
  return block;
}

/// The ends of a ramp, whose colours tell values apart to about a tenth of it, with their unit.
std::array<std::string, 2> ramp_ends(const ColorLegend& legend, const std::string& unit) {
  const double span = legend.high - legend.low;
  std::array<std::string, 2> ends;
  for (const std::size_t i : {0U, 1U}) {
    const double value = i == 0 ? legend.low : legend.high;
    ends.at(i) =
        (span > 0.0 ? rounded_text(value, decimals_of(RAMP_TOLD_APART * span)) : number_text(value)) +
        (unit.empty() ? "" : " " + unit);
  }
  return ends;
}

void add_ramp(const ColorLegend& legend, const std::string& unit, double width_mm, Drawing& block) {
  const auto [low, high] = ramp_ends(legend, unit);
  const double labels = text_width(low, LABEL_SIZE_MM) + text_width(high, LABEL_SIZE_MM) + KEY_GAP;
  const double width = std::max(std::min(RAMP_MOST, width_mm), labels), top = block.size.y;
  for (int i = 0; i < RAMP_BOXES; ++i) {
    const auto step = static_cast<std::size_t>(
        std::lround((i + 0.5) / RAMP_BOXES * static_cast<double>(legend.ramp.size() - 1)));
    block.boxes.push_back({{i * width / RAMP_BOXES, top},
                           {width / RAMP_BOXES + 0.02, RAMP_HEIGHT},
                           linear_to_srgb(unpack_color(legend.ramp[step]))});
  }
  const double base = top + RAMP_HEIGHT + 0.9 * line_height(LABEL_SIZE_MM);
  block.texts.push_back({{0.0, base}, LABEL_SIZE_MM, TextAnchor::begin, low});
  block.texts.push_back({{width, base}, LABEL_SIZE_MM, TextAnchor::end, high});
  block.size = {width, top + RAMP_HEIGHT + 1.2 * line_height(LABEL_SIZE_MM)};
}

void add_categories(const ColorLegend& legend, double width_mm, Drawing& block) {
  const auto text_of = [](const Category& category) {
    return std::to_string(category.value) + (category.name.empty() ? "" : " " + category.name);
  };
  double widest = 0.0;
  for (const Category& category : legend.categories)
    widest = std::max(widest, text_width(text_of(category), LABEL_SIZE_MM));
  const double before = SWATCH + SWATCH_BESIDE, entry = std::min(before + widest + KEY_GAP, width_mm);
  const auto columns = static_cast<std::size_t>(std::max(std::floor(width_mm / entry), 1.0));
  double y = block.size.y, row = 0.0;
  for (std::size_t i = 0; i < legend.categories.size(); ++i) {
    const Category& category = legend.categories[i];
    if (i % columns == 0) y += std::exchange(row, 0.0);
    const glm::dvec2 corner(static_cast<double>(i % columns) * entry, y);
    block.boxes.push_back({corner, {SWATCH, SWATCH}, linear_to_srgb(unpack_color(category.color))});
    const double text = add_text(text_of(category), LABEL_SIZE_MM, entry - before - 0.5 * KEY_GAP,
                                 corner + glm::dvec2(before, 0.0), block);
    row = std::max({row, text, SWATCH + PAD});
  }
  block.size = {width_mm, y + row};
}

/// What the colours mean.
Drawing legend_block(const Sheet& sheet, double width_mm) {
  const ColorLegend& legend = sheet.legend;
  const bool is_length = legend.title == "height" || legend.title == "distance" || legend.title == "change";
  Drawing block;
  block.size.y = add_text(legend.title, TEXT_SIZE_MM, width_mm, {0.0, 0.0}, block);
  if (!legend.ramp.empty())
    add_ramp(legend, is_length ? length_symbol(sheet.unit_metres) : std::string(), width_mm, block);
  if (!legend.categories.empty()) add_categories(legend, width_mm, block);
  return block;
}

}  // namespace

std::string scale_text(const Sheet& sheet) { return "1 : " + number_text(sheet.asked.scale); }

Drawing title_block(const PageWords& words, const Sheet& sheet, const std::string& paper, double width_mm) {
  const TitleBlock& block = words.block;
  const std::vector<std::vector<Cell>> rows = {
      {{"Project", block.project}},
      {{"Title", words.title, TITLE_SIZE}},
      {{"Number", block.number}, {"Sheet", block.sheet}, {"Revision", block.revision}},
      {{"Author", block.author}, {"Date", block.date}, {"Scale", scale_text(sheet)}, {"Paper", paper}},
      {{"Coordinates", system_text(sheet)}}};
  Drawing table;
  table.size.x = width_mm;
  for (const std::vector<Cell>& cells : rows) {
    const Drawing row = cell_row(cells, width_mm);
    add_block(row, {0.0, table.size.y}, table);
    table.lines.push_back({{0.0, table.size.y}, {width_mm, table.size.y}, CELL_LINE_MM});
    table.size.y += row.size.y;
  }
  for (const double x : {0.0, width_mm}) table.lines.push_back({{x, 0.0}, {x, table.size.y}, CELL_LINE_MM});
  table.lines.push_back({{0.0, table.size.y}, {width_mm, table.size.y}, CELL_LINE_MM});
  return table;
}

Drawing caption_block(std::size_t number, const Sheet& sheet, double width_mm) {
  Drawing block;
  const double left = sheet.north_up ? NORTH_WIDTH + KEY_GAP : 0.0;
  if (sheet.north_up) {
    const Drawing north = north_block();
    add_block(north, {0.0, 0.0}, block);
    block.size.y = north.size.y;
  }
  std::string words = std::to_string(number) + "  " + subject_text(sheet);
  if (sheet.asked.contours) words += ", contours every " + length_text(sheet, *sheet.asked.contours);
  const double text = add_text(words, TEXT_SIZE_MM, width_mm - left, {left, 0.0}, block);
  block.size = {width_mm, std::max(block.size.y, text)};
  return block;
}

Drawing key_block(const PageKey& key, double width_mm) {
  Drawing block;
  block.size.x = width_mm;
  double left = 0.0;
  const auto add_below = [&block](const Drawing& part, double x) {
    add_block(part, {x, block.size.y}, block);
    return part.size.y;
  };
  double row = 0.0;
  if (key.has_north) {
    row = add_below(north_block(), 0.0);
    left = NORTH_WIDTH + KEY_GAP;
  }
  row = std::max(row, add_below(bar_block(key.sheet, width_mm - left), left));
  block.size.y = row + 0.5 * KEY_GAP;
  for (const std::vector<std::string>& notes : {key.notes, key.measures.notes})
    for (const std::string& note : notes)
      block.size.y += add_text(note, TEXT_SIZE_MM, width_mm, {0.0, block.size.y}, block);
  if (const Drawing table = measure_table(key.measures.rows, width_mm); table.size.y > 0.0) {
    block.size = glm::max(block.size, glm::dvec2(table.size.x, 0.0)) + glm::dvec2(0.0, 0.25 * KEY_GAP);
    block.size.y += add_below(table, 0.0);
  }
  if (key.sheet.legend.title.empty()) return block;
  block.size.y += 0.5 * KEY_GAP;
  block.size.y += add_below(legend_block(key.sheet, width_mm), 0.0);
  return block;
}

std::string subject_text(const Sheet& sheet) {
  static constexpr std::array NAMES = {"Plan", "Section", "Elevation",
                                       "View along a direction"};  // SheetKind, of one sheet
  std::string subject = NAMES.at(static_cast<std::size_t>(sheet.asked.kind));
  if (sheet.asked.height) subject += ", cut at height " + length_text(sheet, *sheet.asked.height);
  if (sheet.asked.kind == SheetKind::section)
    subject += " along " + number_text(sheet.asked.place[0]) + ", " + number_text(sheet.asked.place[1]) +
               " to " + number_text(sheet.asked.place[2]) + ", " + number_text(sheet.asked.place[3]);
  if (sheet.asked.kind == SheetKind::elevation) subject += " from " + side_text(sheet.asked.place[0]);
  if (sheet.asked.depth) subject += ", " + length_text(sheet, *sheet.asked.depth) + " deep";
  return subject;
}

std::vector<std::string> sheet_notes(const Sheet& sheet, PageOf page) {
  std::vector<std::string> notes = {"A pixel is " + length_text(sheet, sheet.pixel_world) + ", " +
                                    number_text(sheet.asked.dpi) + " dpi"};
  if (sheet.asked.level) {
    std::string levels = "Levels from " + level_text(sheet, *sheet.asked.level) + " at height " +
                         length_text(sheet, *sheet.asked.level);
    for (std::size_t i = 0; page == PageOf::one_sheet && i < sheet.levels.size(); ++i)
      levels += (i == 0 ? ": " : ", ") + level_text(sheet, sheet.levels[i]);
    notes.push_back(levels);
  }
  if (sheet.asked.contours && page == PageOf::one_sheet)
    notes.push_back("Contours every " + length_text(sheet, *sheet.asked.contours));
  if (!sheet.unit_known) notes.emplace_back("The file names no unit; its coordinates are taken for metres");
  return notes;
}

}  // namespace splatray
