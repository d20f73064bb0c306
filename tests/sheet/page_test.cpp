// Pages of sheets: nothing covers anything else or leaves the page, whatever its size and texts are.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <utility>

#include "app/library/sheet/sheet_files.h"
#include "app/library/sheet/sheet_page.h"
#include "app/library/sheet/text_block.h"
#include "app/library/shot/sheet_placement.h"
#include "engine/base/error.h"
#include "engine/scene/splat.h"
#include "tests/sheet/sheet_of_ball.h"

namespace splatray {
namespace {

using testing::ball, testing::with_sheet;

PixelWindow all_of(const Sheet& sheet) { return {0, 0, sheet.width, sheet.height}; }

Drawing page_of(const Sheet& sheet, const PageWords& words = {"Ball", {}}) {
  return sheet_page(sheet, all_of(sheet), words, {});
}

bool has(const Drawing& page, const std::string& text) {
  return std::any_of(page.texts.begin(), page.texts.end(),
                     [&](const DrawnText& drawn) { return drawn.text == text; });
}

/// Within rounding.
bool crosses(const DrawnLine& line, const TextBox& box) {
  const glm::dvec2 low = glm::min(line.from, line.to) + 1e-9, high = glm::max(line.from, line.to) - 1e-9;
  return box.meets({glm::min(low, high), glm::max(low, high)});
}

/// What is wrong with a page: texts that cover each other, lines outside of the picture, or the page's end.
std::vector<std::string> findings(const Drawing& page) {
  std::vector<std::string> found;
  const TextBox paper{{0.0, 0.0}, page.size};
  std::vector<TextBox> pictures;
  for (const DrawnRaster& raster : page.rasters) {
    const TextBox picture{raster.corner, raster.corner + raster.size};
    if (!paper.holds(picture)) found.emplace_back("a picture leaves the page");
    for (const TextBox& other : pictures)
      if (picture.meets(other)) found.emplace_back("a picture covers another");
    pictures.push_back(picture);
  }
  std::vector<TextBox> boxes;
  for (const DrawnText& text : page.texts) boxes.push_back(text_box(text));
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const std::string& text = page.texts[i].text;
    if (!paper.holds(boxes[i])) found.push_back("'" + text + "' leaves the page");
    for (std::size_t j = 0; j < i; ++j)
      if (boxes[i].meets(boxes[j])) found.push_back("'" + text + "' covers '" + page.texts[j].text + "'");
    const auto holds = [&box = boxes[i]](const TextBox& picture) { return picture.holds(box); };
    if (std::any_of(pictures.begin(), pictures.end(), holds)) continue;
    for (const TextBox& picture : pictures)
      if (boxes[i].meets(picture)) found.push_back("'" + text + "' covers a picture's border");
    for (const DrawnLine& line : page.lines)
      if (crosses(line, boxes[i])) found.push_back("a line crosses '" + text + "'");
  }
  for (const DrawnLine& line : page.lines)
    for (const glm::dvec2& end : {line.from, line.to})
      if (!paper.holds({end, end})) found.emplace_back("a line leaves the page");
  for (const DrawnBox& box : page.boxes)
    if (!paper.holds({box.corner, box.corner + box.size})) found.emplace_back("a box leaves the page");
  return found;
}

/// Sheets, texts and measures by chance.
class Chance {
 public:
  explicit Chance(unsigned seed) : random_(seed) {}

  double between(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
  int below(int count) { return std::uniform_int_distribution(0, count - 1)(random_); }

  /// None, a few words, or very many letters without a blank.
  std::string text() {
    static constexpr std::array LETTERS = {"W", "i", "g", "\u00C4", "\u4E2D", "<", "&", "\t", "  ", "j."};
    std::string text;
    const int words = below(4) == 0 ? 0 : below(12), most = below(8) == 0 ? 120 : 12;
    for (int i = 0; i < words; ++i) {
      for (int j = below(most); j >= 0; --j) text += LETTERS.at(static_cast<std::size_t>(below(10)));
      text += ' ';
    }
    return text;
  }

  Sheet sheet() {
    Sheet sheet;
    static constexpr std::array KINDS = {"plan", "plan:z=1.23", "section:0,1,2.5,100000.123,depth=3",
                                         "elevation:17.5", "ortho:1,1,-1"};
    sheet.asked = read_sheet(KINDS.at(static_cast<std::size_t>(below(5))));
    sheet.asked.turn = static_cast<PaperTurn>(below(3));
    sheet.asked.scale = std::pow(10.0, between(0.0, 5.0));
    sheet.asked.dpi = between(20.0, 600.0);
    sheet.north_up = below(2) == 0;
    sheet.unit_metres = below(2) == 0 ? 1.0 : 0.3048006096012192;
    sheet.pixel_world = sheet.pixel_mm() * sheet.asked.scale / 1000.0 / sheet.unit_metres;
    const double most = below(3) == 0 ? 1300.0 : 200.0;
    sheet.width = static_cast<std::uint32_t>(between(0.1, most) / sheet.pixel_mm()) + 1;
    sheet.height = static_cast<std::uint32_t>(between(0.1, most) / sheet.pixel_mm()) + 1;
    sheet.corner = {between(-1.0, 1.0) * std::pow(10.0, below(8)),
                    between(-1.0, 1.0) * std::pow(10.0, below(8))};
    sheet.legend = legend();
    return sheet;
  }

  /// Views in the first one's scale, or floors of its size.
  SheetSet set() {
    SheetSet set{{sheet()}, below(3) == 0};
    const Sheet first = set.sheets[0];
    for (int i = below(5); i >= 0; --i) {
      Sheet other = sheet();
      const SheetRequest own = std::exchange(other.asked, first.asked);
      other.asked.kind = own.kind;
      other.asked.place = own.place;
      other.unit_metres = first.unit_metres;
      other.pixel_world = first.pixel_world;
      const double most = set.is_atlas ? 1.0 : between(0.1, 1.0);
      other.width = static_cast<std::uint32_t>(most * first.width) + 1;
      other.height = static_cast<std::uint32_t>(most * first.height) + 1;
      set.sheets.push_back(other);
    }
    for (std::size_t i = 0; set.is_atlas && i < set.sheets.size(); ++i)
      set.sheets[i].floor = 1234.5 * static_cast<double>(i);
    return set;
  }

  PageWords words() { return {text(), {text(), text(), text(), text(), text(), text()}}; }

  /// Distances on the sheet, many of them near each other.
  std::vector<Measure> measures(const Sheet& sheet) {
    std::vector<Measure> measures(static_cast<std::size_t>(below(8)));
    for (Measure& measure : measures)
      for (int i = 0; i < 2; ++i) {
        const glm::dvec2 at =
            sheet.corner + glm::dvec2(between(0.0, 1.0) * sheet.width, between(-0.3, 0.0) * sheet.height) *
                               sheet.pixel_world;
        measure.points.push_back({at.x * sheet.right + at.y * sheet.top});
      }
    return measures;
  }

 private:
  ColorLegend legend() {
    const int kind = below(3);
    if (kind == 0) return {};
    if (kind == 1)
      return {"height", -123456.7, 0.000123, {pack_color(vec3(0.0F)), pack_color(vec3(1.0F))}, {}};
    ColorLegend classes{text() + "x", 0.0, 0.0, {}, {}};
    for (int i = below(30); i >= 0; --i)
      classes.categories.push_back({static_cast<std::uint32_t>(i), text(), pack_color(vec3(0.5F)), 1});
    return classes;
  }

  std::mt19937 random_;
};

TEST(SheetPage, HasNothingThatCoversOrLeavesAnything) {
  Chance chance(11);
  std::size_t words = 0;
  for (int i = 0; i < 50; ++i) {
    const Sheet sheet = chance.sheet();
    const Drawing page = sheet_page(sheet, all_of(sheet), chance.words(), chance.measures(sheet));
    EXPECT_EQ(findings(page), std::vector<std::string>{}) << "sheet " << i;
    words += page.texts.size();
  }
  EXPECT_GT(words, 50U * 20U);
}

TEST(SheetPage, OfSeveralSheetsHasNothingThatCoversOrLeavesAnything) {
  Chance chance(12);
  for (int i = 0; i < 50; ++i) {
    const SheetSet set = chance.set();
    const std::vector<Drawing> pages = sheet_pages(set, chance.words(), chance.measures(set.sheets[0]));
    EXPECT_EQ(pages.size(), set.is_atlas ? set.sheets.size() : 1U);
    for (const Drawing& page : pages) EXPECT_EQ(findings(page), std::vector<std::string>{}) << "set " << i;
  }
}

TEST(SheetPage, IsFoundFaultWithWhereSomethingIsMoved) {
  const Sheet sheet = make_sheet(ball(), with_sheet("plan:scale=20,dpi=100"));
  const Drawing page = page_of(sheet);
  ASSERT_EQ(findings(page), std::vector<std::string>{});
  for (std::size_t i = 1; i < page.texts.size(); ++i) {
    Drawing moved = page;
    moved.texts[i].at = page.texts[0].at;
    EXPECT_FALSE(findings(moved).empty()) << page.texts[i].text << " on " << page.texts[0].text;
  }
  Drawing moved = page;
  moved.texts[0].at.x = page.size.x;
  EXPECT_FALSE(findings(moved).empty()) << "beyond the right border";
  moved = page;
  moved.texts.back().text += std::string(300, 'W');
  EXPECT_FALSE(findings(moved).empty()) << "a text that is not measured";
}

TEST(SheetPage, HasItsPictureAtScaleAndWordsAroundIt) {
  const Sheet sheet = make_sheet(ball(), with_sheet("plan:scale=20,dpi=100"));
  const Drawing page = page_of(sheet, {"Ball", {"Town hall", "A-101", "2 of 7", "b", "NN", "2026-11-28"}});
  EXPECT_DOUBLE_EQ(page.rasters.front().size.x, sheet.width * 25.4 / 100.0);
  for (const char* text : {"Ball", "1 : 20", "N", "500000", "5000000", "Town hall", "A-101", "2 of 7", "b",
                           "NN", "2026-11-28", "Project", "Revision", "A4"})
    EXPECT_TRUE(has(page, text)) << text;
}

TEST(SheetPage, SaysWhatColoursMean) {
  Sheet sheet = make_sheet(ball(), with_sheet("plan:scale=20,dpi=100"));
  const Drawing bare = page_of(sheet);
  sheet.legend = {"height", 99.0, 101.25, {pack_color(vec3(0.0F)), pack_color(vec3(1.0F, 0.0F, 0.0F))}, {}};
  const Drawing ramp = page_of(sheet);
  EXPECT_TRUE(has(ramp, "height") && has(ramp, "99.00 m") && has(ramp, "101.25 m"));
  EXPECT_TRUE(std::any_of(ramp.boxes.begin(), ramp.boxes.end(),
                          [](const DrawnBox& box) { return box.fill.x > 0.99F && box.fill.y < 0.01F; }));
  sheet.legend.low = -0.00127903;
  const Drawing from_zero = page_of(sheet);
  EXPECT_TRUE(has(from_zero, "0 m") && has(from_zero, "101 m")) << "a colour tells no more apart";
  sheet.legend = {"class", 0.0, 0.0, {}, {}};
  for (const std::uint32_t value : {2U, 5U, 6U, 9U, 17U})
    sheet.legend.categories.push_back({value, class_name(value), pack_color(vec3(0.0F, 1.0F, 0.0F)), 1});
  const Drawing classes = page_of(sheet);
  EXPECT_TRUE(has(classes, "class") && has(classes, "6 " + class_name(6)));
  EXPECT_EQ(classes.boxes.size(), bare.boxes.size() + 5);
}

TEST(SheetPage, IsTheSmallestPaperThatHoldsTheDrawing) {
  Sheet sheet;
  sheet.asked.dpi = 25.4;  // a pixel is a millimetre
  const auto size_of = [&](std::uint32_t width, std::uint32_t height, const std::string& paper,
                           PaperTurn turn) {
    sheet.width = width;
    sheet.height = height;
    sheet.asked.paper = paper;
    sheet.asked.turn = turn;
    return page_of(sheet).size;
  };
  const PaperTurn any = PaperTurn::chosen;
  EXPECT_EQ(size_of(100, 120, "", any), glm::dvec2(210.0, 297.0));
  EXPECT_EQ(size_of(120, 100, "", PaperTurn::landscape), glm::dvec2(297.0, 210.0));
  EXPECT_EQ(size_of(230, 100, "", any), glm::dvec2(297.0, 210.0));
  EXPECT_EQ(size_of(300, 180, "", any), glm::dvec2(420.0, 297.0));
  EXPECT_EQ(size_of(700, 1000, "", any), glm::dvec2(841.0, 1189.0));
  EXPECT_EQ(size_of(10, 10, "A2", PaperTurn::portrait), glm::dvec2(420.0, 594.0));
  EXPECT_EQ(size_of(12, 10, "A1", any), glm::dvec2(841.0, 594.0));
  const glm::dvec2 large = size_of(2000, 1500, "", any);
  EXPECT_TRUE(large.x > 2000.0 && large.x < 2060.0 && large.y > 1500.0 && large.y < 1620.0)
      << large.x << " x " << large.y;
  try {
    (void)size_of(300, 180, "A4", any);
    FAIL() << "300 mm on A4";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_NE(std::string(error.what()).find("for which A4 has no room"), std::string::npos) << error.what();
  }
}

TEST(SheetPage, HasValuesOfMeasuresWhereTheyCoverNothing) {
  Sheet sheet;
  sheet.asked.dpi = 25.4;
  sheet.width = sheet.height = 60;
  sheet.corner = {0.0, 60.0};
  const Measure measure{MeasureKind::distance, {{{20.0, 20.0, 0.0}}, {{40.0, 20.0, 0.0}}}};
  const Drawing one = sheet_page(sheet, all_of(sheet), {}, std::vector(1, measure));
  EXPECT_TRUE(has(one, "1: 20 m"));
  for (const char* cell :
       {"No.", "Name", "Kind", "Value", "\u00B1 (95 %)", "Unit", "1", "distance", "20", "m"})
    EXPECT_TRUE(has(one, cell)) << cell;
  const Drawing many = sheet_page(sheet, all_of(sheet), {}, std::vector(200, measure));
  EXPECT_EQ(findings(many), std::vector<std::string>{});
  EXPECT_TRUE(std::any_of(many.texts.begin(), many.texts.end(), [](const DrawnText& text) {
    return text.text.find("No room at their places for the numbers of") != std::string::npos;
  }));
}

TEST(SheetFiles, SvgHasItsWordsAsText) {
  Shot shot;
  Sheet sheet = make_sheet(ball(), with_sheet("plan:scale=20,dpi=20"));
  shot.view.width = sheet.width;
  shot.view.height = sheet.height;
  shot.request.output.title = "Hall & <yard>";
  const DisplayImage picture{sheet.width, sheet.height,
                             std::vector<vec3>(std::size_t{sheet.width} * sheet.height)};
  shot.output = sheet;
  const auto bytes = encode_sheet(shot, picture, {}, "a.svg");
  const std::string svg(bytes.begin(), bytes.end());
  EXPECT_NE(svg.find(">Hall &amp; &lt;yard&gt;</text>"), std::string::npos);
  EXPECT_EQ(svg.find("glyph"), std::string::npos) << "letters as outlines";
}

TEST(TitleBlockText, IsReadAndWrittenAlike) {
  const std::string text = "project=Town hall;number=A-101;sheet=2/7;revision=b;author=NN;date=2026-11-28";
  EXPECT_EQ(title_block_text(read_title_block(text)), text);
  EXPECT_EQ(read_title_block("date=1 = 2").date, "1 = 2");
  for (const char* wrong : {"project", "project=", "owner=NN", "project=a;", ";", "=a"}) {
    Request request;
    EXPECT_THROW(assign(request, {{"title-block", wrong}}, DOOR_RENDER), Error) << wrong;
  }
}

}  // namespace
}  // namespace splatray
