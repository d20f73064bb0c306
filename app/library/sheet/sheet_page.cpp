#include "app/library/sheet/sheet_page.h"

#include <algorithm>
#include <array>
#include <cmath>

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

struct Paper {
  std::string name;
  glm::dvec2 size{0.0};

  [[nodiscard]] glm::dvec2 frame() const { return size - glm::dvec2(BINDING + MARGIN, 2.0 * MARGIN); }
};

/// What goes on a page, whatever its paper is.
struct Content {
  const Sheet& sheet;
  const PageWords& words;
  Drawing view;
  ShownMeasures measures;
};

/// What stands below the drawing, as wide as the frame: the key to the left of the title block, or above it where that takes all.
Drawing foot_block(const Content& content, const std::string& paper, double width) {
  const Drawing title = title_block(content.words, content.sheet, paper, TITLE_WIDTH);
  const double room = width - 2.0 * AROUND, room_beside = room - TITLE_WIDTH;
  const auto key_in = [&content](double mm) {
    return key_block(content.sheet, content.measures, sheet_notes(content.sheet), mm);
  };
  Drawing key = key_in(std::max(room_beside, KEY_LEAST));
  const bool beside = key.size.x <= room_beside;
  if (!beside) key = key_in(room);
  Drawing foot;
  foot.size = {width,
               beside ? std::max(title.size.y, key.size.y + AROUND) : title.size.y + key.size.y + AROUND};
  add_block(key, {AROUND, 0.0}, foot);
  add_block(title, foot.size - title.size, foot);
  return foot;
}

/// What the drawing and its foot take of a frame of this width.
glm::dvec2 needed(const Drawing& view, const Drawing& foot) {
  return {std::max(view.size.x + 2.0 * AROUND, foot.size.x), view.size.y + foot.size.y + 2.0 * AROUND};
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
Paper made_to_measure(const Content& content) {
  const double width = std::max(content.view.size.x + 2.0 * AROUND, TITLE_WIDTH);
  const auto of_height = [&](double height) {
    const glm::dvec2 size = glm::ceil(glm::dvec2(width + BINDING + MARGIN, height + 2.0 * MARGIN));
    return Paper{number_text(size.x) + " x " + number_text(size.y) + " mm", size};
  };
  // Twice, as the paper's name is a text of its foot; a millimetre of ceil() is the slack that a longer number may take.
  const Paper first =
      of_height(needed(content.view, foot_block(content, of_height(content.view.size.y).name, width)).y);
  return of_height(needed(content.view, foot_block(content, first.name, width)).y);
}

Paper chosen_paper(const Content& content) {
  const SheetRequest& asked = content.sheet.asked;
  for (const Paper& paper : papers(asked, content.view.size)) {
    const glm::dvec2 frame = paper.frame();
    const glm::dvec2 need = needed(content.view, foot_block(content, paper.name, frame.x));
    if (need.x <= frame.x && need.y <= frame.y) return paper;
  }
  if (asked.paper.empty()) return made_to_measure(content);
  const glm::dvec2 size = glm::ceil(content.view.size);
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
  Content content{sheet, words, sheet_view(sheet, window), {}};
  content.measures = draw_measures(sheet, window, measures, content.view);
  const Paper paper = chosen_paper(content);
  const glm::dvec2 low(BINDING, MARGIN), high = low + paper.frame();
  const Drawing foot = foot_block(content, paper.name, high.x - low.x);
  const glm::dvec2 foot_corner(low.x, high.y - foot.size.y);
  Drawing page;
  page.size = paper.size;
  page.title = words.title;
  add_frame(low, high, page);
  add_block(foot, foot_corner, page);
  const glm::dvec2 room(high.x - low.x, foot_corner.y - low.y);
  const glm::dvec2 view_corner = low + 0.5 * (room - content.view.size);
  add_block(content.view, view_corner, page);
  page.raster = content.view.raster;
  page.raster.corner += view_corner;
  return page;
}

void set_picture(const DisplayImage& picture, Drawing& page) {
  page.raster.width = picture.width;
  page.raster.height = picture.height;
  page.raster.rgba = rgba_bytes(picture);
}

}  // namespace splatray
