#include "app/library/sheet/sheet_page.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <utility>

#include "app/library/sheet/height_marks.h"
#include "app/library/sheet/measure_marks.h"
#include "app/library/sheet/sheet_view.h"
#include "app/library/sheet/text_block.h"
#include "engine/base/error.h"
#include "engine/base/number_text.h"

namespace splatray {
namespace {

// Millimetres. Margins of the frame as ISO 5457 has them, the title block's width as ISO 7200 has it.
constexpr double BINDING = 20.0, MARGIN = 10.0, FRAME_LINE = 0.7;
constexpr double TITLE_WIDTH = 180.0, KEY_LEAST = 75.0, AROUND = 4.0;
constexpr double BETWEEN = 8.0, CAPTION_LEAST = 50.0;  ///< of views
/// What of a floor may lie below its level.
constexpr double FLOOR_METRES = 0.1;

struct Paper {
  std::string name;
  glm::dvec2 size{0.0};

  [[nodiscard]] glm::dvec2 frame() const { return size - glm::dvec2(BINDING + MARGIN, 2.0 * MARGIN); }
};

/// A sheet on its page.
struct ShownView {
  const Sheet* sheet = nullptr;
  Drawing drawing;
};

/// What goes on a page, whatever its paper is.
struct Content {
  PageWords words;
  std::vector<ShownView> views;  ///< one or more
  std::vector<std::string> notes;
  ShownMeasures measures;

  [[nodiscard]] const Sheet& first() const { return *views.front().sheet; }
  /// The one whose coordinates the title block names: the first that has the file's.
  [[nodiscard]] const Sheet& placed() const {
    const auto view =
        std::find_if(views.begin(), views.end(), [](const ShownView& one) { return one.sheet->north_up; });
    return view == views.end() ? first() : *view->sheet;
  }
};

/// Where the views of a page lie from the grid's corner.
struct Grid {
  glm::dvec2 size{0.0};
  std::vector<glm::dvec2> corners;
};

/// Views in rows of so many: below each other with their left borders in one line, beside each other with the lower ones, so that a plan's
/// walls lie over an elevation's, and its floors beside a section's.
Grid grid_of(const std::vector<ShownView>& views, std::size_t columns) {
  const std::size_t rows = (views.size() + columns - 1) / columns;
  std::vector<double> widths(columns), above(rows), below(rows);
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Drawing& view = views[i].drawing;
    const double foot = view.rasters.front().corner.y + view.rasters.front().size.y;
    widths[i % columns] = std::max(widths[i % columns], view.size.x);
    above[i / columns] = std::max(above[i / columns], foot);
    below[i / columns] = std::max(below[i / columns], view.size.y - foot);
  }
  Grid grid;
  glm::dvec2 at(0.0);
  for (std::size_t i = 0; i < views.size(); ++i) {
    const std::size_t column = i % columns, row = i / columns;
    if (column == 0) at = {0.0, row == 0 ? 0.0 : grid.size.y + BETWEEN};
    const DrawnRaster& picture = views[i].drawing.rasters.front();
    grid.corners.push_back(at + glm::dvec2(0.0, above[row] - picture.corner.y - picture.size.y));
    at.x += widths[column] + BETWEEN;
    grid.size = glm::max(grid.size, glm::dvec2(at.x - BETWEEN, at.y + above[row] + below[row]));
  }
  return grid;
}

/// A paper, and how the views of all pages lie on it.
struct Layout {
  Paper paper;
  std::size_t columns = 1;
  double foot_height = 0.0;  ///< of the page that needs the most
};

/// What stands below the drawing, as wide as the frame: the key to the left of the title block, or above it where that takes all.
Drawing foot_block(const Content& content, const std::string& paper, double width) {
  const Drawing title = title_block(content.words, content.placed(), paper, TITLE_WIDTH);
  const double room = width - 2.0 * AROUND, room_beside = room - TITLE_WIDTH;
  const PageKey page_key{content.first(), content.views.size() == 1 && content.first().north_up,
                         content.notes, content.measures};
  Drawing key = key_block(page_key, std::max(room_beside, KEY_LEAST));
  const bool beside = key.size.x <= room_beside;
  if (!beside) key = key_block(page_key, room);
  Drawing foot;
  foot.size = {width,
               beside ? std::max(title.size.y, key.size.y + AROUND) : title.size.y + key.size.y + AROUND};
  add_block(key, {AROUND, 0.0}, foot);
  add_block(title, foot.size - title.size, foot);
  return foot;
}

/// What the foots of all pages take of a frame of this width at most.
glm::dvec2 foot_size(const std::vector<Content>& pages, const std::string& paper, double width) {
  glm::dvec2 size(0.0);
  for (const Content& page : pages) size = glm::max(size, foot_block(page, paper, width).size);
  return size;
}

/// What a drawing and its foot take of a frame.
glm::dvec2 needed(const glm::dvec2& drawing, const glm::dvec2& foot) {
  return {std::max(drawing.x + 2.0 * AROUND, foot.x), drawing.y + foot.y + 2.0 * AROUND};
}

/// What the drawings of all pages take at most.
glm::dvec2 drawn_size(const std::vector<Content>& pages, std::size_t columns) {
  glm::dvec2 size(0.0);
  for (const Content& page : pages) size = glm::max(size, grid_of(page.views, columns).size);
  return size;
}

std::size_t square_columns(const std::vector<Content>& pages) {
  return static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(pages.front().views.size()))));
}

/// Those that may be taken, in this order: small ones first, and first as the drawing lies.
std::vector<Paper> papers(const SheetRequest& asked, const glm::dvec2& drawn) {
  std::vector<Paper> all;
  for (const PaperSize& size : PAPER_SIZES) {
    if (!asked.paper.empty() && asked.paper != size.name) continue;
    const Paper portrait{size.name, {size.short_mm, size.long_mm}};
    const Paper landscape{size.name, {size.long_mm, size.short_mm}};
    const bool is_wide = drawn.x > drawn.y;
    if (asked.turn != PaperTurn::portrait && is_wide) all.push_back(landscape);
    if (asked.turn != PaperTurn::landscape) all.push_back(portrait);
    if (asked.turn != PaperTurn::portrait && !is_wide) all.push_back(landscape);
  }
  return all;
}

/// A paper that holds all and no more.
Layout made_to_measure(const std::vector<Content>& pages) {
  const std::size_t columns = square_columns(pages);
  const glm::dvec2 drawn = drawn_size(pages, columns);
  const double width = std::max(drawn.x + 2.0 * AROUND, TITLE_WIDTH);
  const auto of_height = [&](double height) {
    const glm::dvec2 size = glm::ceil(glm::dvec2(width + BINDING + MARGIN, height + 2.0 * MARGIN));
    return Paper{number_text(size.x) + " x " + number_text(size.y) + " mm", size};
  };
  // Twice, as the paper's name is a text of its foot; a millimetre of ceil() is the slack that a longer number may take.
  const Paper first = of_height(needed(drawn, foot_size(pages, of_height(drawn.y).name, width)).y);
  const Paper paper = of_height(needed(drawn, foot_size(pages, first.name, width)).y);
  return {paper, columns, foot_size(pages, paper.name, paper.frame().x).y};
}

/// How the drawing fits on a paper with the most room around it; nothing where it does not.
std::optional<Layout> fitted(const std::vector<Content>& pages, const Paper& paper) {
  const glm::dvec2 frame = paper.frame(), foot = foot_size(pages, paper.name, frame.x);
  std::optional<Layout> best;
  double fullest = 1.0;
  for (std::size_t columns = 1; columns <= pages.front().views.size(); ++columns) {
    const glm::dvec2 part = needed(drawn_size(pages, columns), foot) / frame;
    if (std::max(part.x, part.y) > fullest) continue;
    fullest = std::max(part.x, part.y);
    best = {paper, columns, foot.y};
  }
  return best;
}

Layout chosen_layout(const std::vector<Content>& pages) {
  const SheetRequest& asked = pages.front().first().asked;
  const glm::dvec2 drawn = drawn_size(pages, square_columns(pages));
  for (const Paper& paper : papers(asked, drawn))
    if (const std::optional<Layout> layout = fitted(pages, paper)) return *layout;
  if (asked.paper.empty()) return made_to_measure(pages);
  const glm::dvec2 size = glm::ceil(drawn);
  throw Error(
      ExitCode::usage,
      "the drawing takes " + number_text(size.x) + " x " + number_text(size.y) +
          " mm at 1 : " + number_text(asked.scale) + ", for which " + asked.paper +
          " has no room above its title block; expected a larger paper=, or a scale of a larger number");
}

void add_frame(const glm::dvec2& low, const glm::dvec2& high, Drawing& page) {
  const std::array<glm::dvec2, 4> corners = {low, {high.x, low.y}, high, {low.x, high.y}};
  for (std::size_t i = 0; i < corners.size(); ++i)
    page.lines.push_back({corners[i], corners[(i + 1) % corners.size()], FRAME_LINE});
}

Drawing page_of(const Content& content, const Layout& layout) {
  const glm::dvec2 low(BINDING, MARGIN), high = low + layout.paper.frame();
  const Drawing foot = foot_block(content, layout.paper.name, high.x - low.x);
  Drawing page;
  page.size = layout.paper.size;
  page.title = content.words.title;
  add_frame(low, high, page);
  add_block(foot, {low.x, high.y - foot.size.y}, page);
  const Grid grid = grid_of(content.views, layout.columns);
  const glm::dvec2 room(high.x - low.x, high.y - layout.foot_height - low.y);
  for (std::size_t i = 0; i < content.views.size(); ++i)
    add_block(content.views[i].drawing, low + 0.5 * (room - grid.size) + grid.corners[i], page);
  return page;
}

std::vector<Drawing> pages_of(const std::vector<Content>& contents) {
  const Layout layout = chosen_layout(contents);
  std::vector<Drawing> pages;
  for (const Content& content : contents) pages.push_back(page_of(content, layout));
  return pages;
}

/// The content of a page with one sheet.
Content content_of(const Sheet& sheet, const PixelWindow& window, const PageWords& words,
                   std::span<const Measure> measures) {
  Content content{words, {{&sheet, sheet_view(sheet, window)}}, {subject_text(sheet)}, {}};
  if (sheet.floor) content.notes.push_back(floor_text(sheet));
  for (const std::string& note : sheet_notes(sheet)) content.notes.push_back(note);
  content.measures = draw_measures(sheet, window, measures, content.views.front().drawing);
  return content;
}

std::string in_sentence(std::string text) {
  text.front() = static_cast<char>(std::tolower(text.front()));
  return text;
}

PixelWindow whole(const Sheet& sheet) { return {0, 0, sheet.width, sheet.height}; }

std::vector<Measure> floor_measures(const SheetSet& atlas, std::size_t index,
                                    std::span<const Measure> measures) {
  const auto begin_of = [&atlas](std::size_t i) {
    const Sheet& sheet = atlas.sheets[i];
    return *sheet.floor - FLOOR_METRES / sheet.unit_metres;
  };
  std::vector<Measure> own(measures.begin(), measures.end());
  for (Measure& measure : own) {
    if (measure.points.empty()) continue;
    double height = 0.0;
    for (const SurfacePoint& point : measure.points)
      height += glm::dot(point.place, glm::normalize(atlas.sheets[index].up)) /
                static_cast<double>(measure.points.size());
    const bool is_below = index > 0 && height < begin_of(index);
    const bool is_above = index + 1 < atlas.sheets.size() && height >= begin_of(index + 1);
    if (is_below || is_above) measure = {};
  }
  return own;
}

/// Length of a measure's lines on a sheet, world units; nothing where a point of it lies beside.
std::optional<double> length_on(const Sheet& sheet, const Measure& measure) {
  double length = 0.0;
  std::optional<glm::dvec2> before;
  for (const SurfacePoint& point : measure.points) {
    const glm::dvec2 at = sheet.on_paper(point.place), pixel = sheet.pixel_of(at);
    if (pixel.x < 0.0 || pixel.y < 0.0 || pixel.x > sheet.width || pixel.y > sheet.height) return {};
    if (before) length += glm::distance(*before, at);
    before = at;
  }
  return length;
}

/// The view that shows a measure the longest, the first of such; the views' count where none does.
std::size_t view_of(const SheetSet& set, const Measure& measure) {
  constexpr double LONGER = 1.01;  // as the first one has it
  std::size_t best = set.sheets.size();
  double longest = 0.0;
  for (std::size_t i = 0; i < set.sheets.size(); ++i) {
    const std::optional<double> length = length_on(set.sheets[i], measure);
    if (!length || (best < set.sheets.size() && *length <= LONGER * longest)) continue;
    best = i;
    longest = *length;
  }
  return best;
}

Content floor_content(const SheetSet& atlas, std::size_t index, const PageWords& words,
                      std::span<const Measure> measures) {
  const Sheet& sheet = atlas.sheets[index];
  PageWords own = words;
  own.block.sheet += (own.block.sheet.empty() ? "" : " ") + std::to_string(index + 1) + "/" +
                     std::to_string(atlas.sheets.size());
  own.title += own.title.empty() ? floor_text(sheet) : ", " + in_sentence(floor_text(sheet));
  return content_of(sheet, whole(sheet), own, floor_measures(atlas, index, measures));
}

/// Adds what a view shows, by the measures' numbers.
void add_rows(const ShownMeasures& shown, ShownMeasures& all) {
  all.notes.insert(all.notes.end(), shown.notes.begin(), shown.notes.end());
  all.rows.insert(all.rows.end(), shown.rows.begin(), shown.rows.end());
  std::stable_sort(all.rows.begin(), all.rows.end(),
                   [](const MeasureRow& a, const MeasureRow& b) { return a.id < b.id; });
}

/// A page of all views.
Content views_content(const SheetSet& set, const PageWords& words, std::span<const Measure> measures) {
  Content content{words, {}, {}, {}};
  content.notes = sheet_notes(set.sheets.front(), PageOf::views);
  for (const Sheet& sheet : set.sheets) {
    ShownView view{&sheet, sheet_view(sheet, whole(sheet))};
    const std::vector<Measure> own = measures_of_sheet(set, content.views.size(), measures);
    add_rows(draw_measures(sheet, whole(sheet), own, view.drawing), content.measures);
    view.drawing.size.x = std::max(view.drawing.size.x, CAPTION_LEAST);
    const Drawing caption = caption_block(content.views.size() + 1, sheet, view.drawing.size.x);
    add_block(caption, {0.0, view.drawing.size.y}, view.drawing);
    view.drawing.size.y += caption.size.y;
    content.views.push_back(std::move(view));
  }
  return content;
}

}  // namespace

std::vector<std::uint8_t> rgba_bytes(const DisplayImage& picture) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(4 * picture.rgb.size());
  const auto byte = [](float value) { return static_cast<std::uint8_t>(std::lround(255.0F * value)); };
  for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
    for (int channel = 0; channel < 3; ++channel) bytes.push_back(byte(picture.rgb[i][channel]));
    bytes.push_back(picture.alpha.empty() ? std::uint8_t{255} : byte(picture.alpha[i]));
  }
  return bytes;
}

Drawing sheet_page(const Sheet& sheet, const PixelWindow& window, const PageWords& words,
                   std::span<const Measure> measures) {
  return std::move(pages_of({content_of(sheet, window, words, measures)}).front());
}

std::vector<Drawing> sheet_pages(const SheetSet& set, const PageWords& words,
                                 std::span<const Measure> measures) {
  if (!set.is_atlas) return pages_of({views_content(set, words, measures)});
  std::vector<Content> contents;
  for (std::size_t i = 0; i < set.sheets.size(); ++i)
    contents.push_back(floor_content(set, i, words, measures));
  return pages_of(contents);
}

std::vector<Measure> measures_of_sheet(const SheetSet& set, std::size_t index,
                                       std::span<const Measure> measures) {
  if (set.is_atlas) return floor_measures(set, index, measures);
  std::vector<Measure> own(measures.begin(), measures.end());
  for (Measure& measure : own)
    if (view_of(set, measure) != index) measure = {};
  return own;
}

std::string floor_text(const Sheet& sheet) {
  if (sheet.asked.level) return "Floor at " + level_text(sheet, *sheet.floor);
  return "Floor at height " + height_text(sheet, *sheet.floor);
}

void set_picture(const DisplayImage& picture, Drawing& page, std::size_t index) {
  DrawnRaster& raster = page.rasters[index];
  raster.width = picture.width;
  raster.height = picture.height;
  raster.rgba = rgba_bytes(picture);
}

}  // namespace splatray
