#include "app/library/sheet/sheet_page.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "engine/base/crs.h"
#include "engine/base/length_unit.h"
#include "engine/base/number_text.h"
#include "engine/base/srgb.h"
#include "engine/scene/splat.h"

namespace splatray {
namespace {

// Millimetres.
constexpr double MARGIN = 14.0, FOOT = 30.0, LEAST_WIDTH = 120.0;
constexpr double TICK = 2.0, GRID_LEAST = 30.0, CROSS = 1.5;
constexpr double BAR_MOST = 60.0, BAR_HEIGHT = 1.6;
constexpr double TITLE_SIZE = 5.0, TEXT_SIZE = 2.8, LABEL_SIZE = 2.2;
constexpr double FRAME_LINE = 0.25, FINE_LINE = 0.13;
constexpr double RAMP_WIDTH = 60.0, RAMP_HEIGHT = 3.0;
constexpr double SWATCH = 3.0, ENTRY_WIDTH = 46.0, ENTRY_HEIGHT = 5.0;
constexpr int RAMP_BOXES = 60;

/// The largest of 1, 2, 5 times a power of ten that is at most `most`, or the least that is at least that.
double round_length(double most, bool up) {
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  if (up) {
    for (const double step : {1.0, 2.0, 5.0})
      if (step * power >= most) return step * power;
    return 10.0 * power;
  }
  double best = power;
  for (const double step : {2.0, 5.0})
    if (step * power <= most) best = step * power;
  return best;
}

std::string fixed(double value, int digits) {
  const double step = std::pow(10.0, -digits);
  if (std::abs(value) < 0.5 * step) value = 0.0;  // not -0
  std::array<char, 64> text{};
  (void)std::snprintf(text.data(), text.size(), "%.*f", digits, value);
  return text.data();
}

/// A length in the file's units, such as "1.2 m".
std::string length_text(const Sheet& sheet, double world) {
  const LengthUnit* unit = find_length_unit(sheet.unit_metres);
  return number_text(std::round(world * 1e6) / 1e6) + " " + (unit != nullptr ? unit->symbol : "units");
}

/// Entries of a legend side by side on a page so wide, millimetres.
std::size_t entries_in_a_row(double width) {
  return static_cast<std::size_t>(std::max(std::floor(width / ENTRY_WIDTH), 1.0));
}

/// What a legend takes below all else, millimetres.
double legend_height(const ColorLegend& legend, double width) {
  if (legend.title.empty()) return 0.0;
  if (!legend.ramp.empty()) return 2.0 * ENTRY_HEIGHT + RAMP_HEIGHT;
  const std::size_t row = entries_in_a_row(width);
  return ENTRY_HEIGHT * (1.0 + std::ceil(double(legend.categories.size()) / double(row)));
}

class Page {
 public:
  Page(const Sheet& sheet, const PixelWindow& window, Drawing& drawing)
      : sheet_(sheet),
        window_(window),
        drawing_(drawing),
        corner_(drawing.raster.corner),
        size_(drawing.raster.size),
        mm_world_(sheet.pixel_world / sheet.pixel_mm()) {}

  void add_frame() {
    const glm::dvec2 end = corner_ + size_;
    const std::array<glm::dvec2, 4> corners = {corner_, {end.x, corner_.y}, end, {corner_.x, end.y}};
    for (std::size_t i = 0; i < corners.size(); ++i)
      drawing_.lines.push_back({corners[i], corners[(i + 1) % corners.size()], FRAME_LINE});
  }

  /// Ticks with coordinates at the border, crosses where they meet.
  void add_grid() {
    const double step = round_length(GRID_LEAST * mm_world_, true);
    const int digits = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 6);
    const glm::dvec2 top_left = sheet_.at(window_.x, window_.y);
    const glm::dvec2 end = corner_ + size_;
    std::vector<double> across, along;  // millimetres
    for (double x = std::ceil(top_left.x / step) * step; (x - top_left.x) / mm_world_ <= size_.x; x += step) {
      const double at = corner_.x + (x - top_left.x) / mm_world_;
      across.push_back(at);
      drawing_.lines.push_back({{at, corner_.y - TICK}, {at, corner_.y}, FINE_LINE});
      drawing_.lines.push_back({{at, end.y}, {at, end.y + TICK}, FINE_LINE});
      drawing_.texts.push_back(
          {{at, corner_.y - TICK - 0.8}, LABEL_SIZE, TextAnchor::middle, fixed(x, digits)});
    }
    for (double y = std::floor(top_left.y / step) * step; (top_left.y - y) / mm_world_ <= size_.y;
         y -= step) {
      const double at = corner_.y + (top_left.y - y) / mm_world_;
      along.push_back(at);
      drawing_.lines.push_back({{corner_.x - TICK, at}, {corner_.x, at}, FINE_LINE});
      drawing_.lines.push_back({{end.x, at}, {end.x + TICK, at}, FINE_LINE});
      drawing_.texts.push_back(
          {{corner_.x - TICK - 0.8, at}, LABEL_SIZE, TextAnchor::middle, fixed(y, digits), true});
    }
    for (const double x : across)
      for (const double y : along) {
        drawing_.lines.push_back({{x - CROSS, y}, {x + CROSS, y}, FINE_LINE});
        drawing_.lines.push_back({{x, y - CROSS}, {x, y + CROSS}, FINE_LINE});
      }
  }

  /// The bar of lengths, four parts of it in turn filled.
  void add_bar() {
    const double length = round_length(std::min(BAR_MOST, size_.x) * mm_world_, false);
    const double part = length / mm_world_ / 4.0;
    const glm::dvec2 at(corner_.x, corner_.y + size_.y + 15.0);
    for (int i = 0; i < 4; ++i) {
      const glm::dvec2 begin(at.x + i * part, at.y), end(begin.x + part, at.y + BAR_HEIGHT);
      if (i % 2 == 0) drawing_.boxes.push_back({begin, end - begin});
      drawing_.lines.push_back({begin, {end.x, begin.y}, FINE_LINE});
      drawing_.lines.push_back({{begin.x, end.y}, end, FINE_LINE});
      drawing_.lines.push_back({{end.x, begin.y}, end, FINE_LINE});
    }
    drawing_.lines.push_back({at, {at.x, at.y + BAR_HEIGHT}, FINE_LINE});
    drawing_.texts.push_back({{at.x, at.y - 1.0}, LABEL_SIZE, TextAnchor::middle, "0"});
    drawing_.texts.push_back(
        {{at.x + 4.0 * part, at.y - 1.0}, LABEL_SIZE, TextAnchor::middle, length_text(sheet_, length)});
    drawing_.texts.push_back({{at.x, at.y + BAR_HEIGHT + 5.0},
                              TITLE_SIZE,
                              TextAnchor::begin,
                              "1 : " + number_text(sheet_.asked.scale)});
  }

  void add_words(const std::string& title) {
    const double right = corner_.x + std::max(size_.x, LEAST_WIDTH - 2.0 * MARGIN);
    double y = corner_.y + size_.y + 11.0;
    drawing_.texts.push_back({{right, y}, TITLE_SIZE, TextAnchor::end, title});
    for (const std::string& line : {subject(), system(), pixels()})
      drawing_.texts.push_back({{right, y += 4.2}, TEXT_SIZE, TextAnchor::end, line});
  }

  /// What the colours mean.
  void add_legend() {
    const ColorLegend& legend = sheet_.legend;
    if (legend.title.empty()) return;
    glm::dvec2 at(corner_.x, corner_.y + size_.y + FOOT);
    const bool is_length = legend.title == "height" || legend.title == "distance" || legend.title == "change";
    const LengthUnit* unit = find_length_unit(sheet_.unit_metres);
    drawing_.texts.push_back(
        {at, TEXT_SIZE, TextAnchor::begin,
         legend.title + (is_length && unit != nullptr ? std::string(", ") + unit->symbol : "")});
    at.y += 1.5;
    legend.ramp.empty() ? add_categories(legend, at) : add_ramp(legend, at);
  }

  /// An arrow to the paper's top, in its top right corner.
  void add_north() {
    const glm::dvec2 foot(corner_.x + size_.x - 7.0, corner_.y + 18.0), tip = foot - glm::dvec2(0.0, 12.0);
    drawing_.lines.push_back({foot, tip, 0.35});
    drawing_.lines.push_back({tip, tip + glm::dvec2(-1.8, 4.0), 0.35});
    drawing_.lines.push_back({tip, tip + glm::dvec2(1.8, 4.0), 0.35});
    drawing_.texts.push_back({tip - glm::dvec2(0.0, 1.0), TEXT_SIZE, TextAnchor::middle, "N"});
  }

 private:
  void add_ramp(const ColorLegend& legend, const glm::dvec2& at) {
    for (int i = 0; i < RAMP_BOXES; ++i) {
      const auto step = static_cast<std::size_t>(
          std::lround((i + 0.5) / RAMP_BOXES * static_cast<double>(legend.ramp.size() - 1)));
      drawing_.boxes.push_back({{at.x + i * RAMP_WIDTH / RAMP_BOXES, at.y},
                                {RAMP_WIDTH / RAMP_BOXES + 0.02, RAMP_HEIGHT},
                                linear_to_srgb(unpack_color(legend.ramp[step]))});
    }
    const double line = at.y + RAMP_HEIGHT + LABEL_SIZE + 0.8;
    const auto six_digits = [](double value) {
      std::array<char, 40> text{};
      (void)std::snprintf(text.data(), text.size(), "%.6g", value);
      return std::string(text.data());
    };
    drawing_.texts.push_back({{at.x, line}, LABEL_SIZE, TextAnchor::begin, six_digits(legend.low)});
    drawing_.texts.push_back(
        {{at.x + RAMP_WIDTH, line}, LABEL_SIZE, TextAnchor::end, six_digits(legend.high)});
  }

  void add_categories(const ColorLegend& legend, const glm::dvec2& at) {
    const std::size_t row = entries_in_a_row(drawing_.size.x - 2.0 * MARGIN);
    for (std::size_t i = 0; i < legend.categories.size(); ++i) {
      const Category& category = legend.categories[i];
      const glm::dvec2 place = at + glm::dvec2(ENTRY_WIDTH, ENTRY_HEIGHT) * glm::dvec2(i % row, i / row);
      drawing_.boxes.push_back({place, {SWATCH, SWATCH}, linear_to_srgb(unpack_color(category.color))});
      drawing_.texts.push_back({place + glm::dvec2(SWATCH + 1.5, SWATCH - 0.4), LABEL_SIZE, TextAnchor::begin,
                                std::to_string(category.value) + "  " + category.name});
    }
  }

  [[nodiscard]] std::string subject() const {
    static constexpr std::array NAMES = {"Plan", "Section", "Elevation",
                                         "View along a direction"};  // SheetKind
    std::string text = NAMES[static_cast<std::size_t>(sheet_.asked.kind)];
    if (sheet_.asked.height) text += ", cut at height " + length_text(sheet_, *sheet_.asked.height);
    if (sheet_.asked.kind == SheetKind::section)
      text += " along " + number_text(sheet_.asked.place[0]) + ", " + number_text(sheet_.asked.place[1]) +
              " to " + number_text(sheet_.asked.place[2]) + ", " + number_text(sheet_.asked.place[3]);
    if (sheet_.asked.depth) text += ", " + length_text(sheet_, *sheet_.asked.depth) + " deep";
    return text;
  }
  [[nodiscard]] std::string system() const {
    const std::string name = describe_crs(sheet_.crs).name;
    const std::string unit = sheet_.unit_known ? "" : "; the file names no unit, taken for metres";
    if (!sheet_.north_up) return "coordinates along the paper and upwards" + unit;
    return (name.empty() ? "coordinates of the file, of no named system" : name) + unit;
  }
  [[nodiscard]] std::string pixels() const {
    return "a pixel is " + length_text(sheet_, sheet_.pixel_world) + ", " + number_text(sheet_.asked.dpi) +
           " dpi";
  }

  const Sheet& sheet_;
  const PixelWindow& window_;
  Drawing& drawing_;
  glm::dvec2 corner_, size_;
  double mm_world_;  ///< world length of a millimetre of paper
};

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

Drawing sheet_page(const Sheet& sheet, const PixelWindow& window, const DisplayImage& picture,
                   const std::string& title) {
  Drawing drawing;
  drawing.title = title;
  drawing.raster.corner = {MARGIN, MARGIN};
  drawing.raster.size = glm::dvec2(window.width, window.height) * sheet.pixel_mm();
  drawing.raster.width = picture.width;
  drawing.raster.height = picture.height;
  drawing.raster.rgba = rgba_bytes(picture);
  drawing.size = {std::max(drawing.raster.size.x + 2.0 * MARGIN, LEAST_WIDTH),
                  drawing.raster.size.y + MARGIN + FOOT + 2.0};
  drawing.size.y += legend_height(sheet.legend, drawing.size.x - 2.0 * MARGIN);
  Page page(sheet, window, drawing);
  page.add_frame();
  page.add_grid();
  page.add_bar();
  page.add_words(title);
  page.add_legend();
  if (sheet.north_up) page.add_north();
  return drawing;
}

void draw_measures(const Sheet& sheet, const PixelWindow& window, std::span<const Measure> measures,
                   const glm::dvec3& up, Drawing& page) {
  constexpr double MARK = 0.8, LINE = 0.25, BESIDE = 1.2;
  const auto on_page = [&](const glm::dvec3& place) {
    const glm::dvec2 pixel = sheet.pixel_of(sheet.on_paper(place)) - glm::dvec2(window.x, window.y);
    return page.raster.corner + pixel * sheet.pixel_mm();
  };
  const glm::dvec2 low = page.raster.corner, high = low + page.raster.size;
  const auto is_on = [&](const glm::dvec2& at) {
    return at.x >= low.x && at.y >= low.y && at.x <= high.x && at.y <= high.y;
  };
  for (const Measure& measure : measures) {
    std::vector<glm::dvec2> places;
    for (const SurfacePoint& point : measure.points) places.push_back(on_page(point.place));
    if (places.empty() || !std::all_of(places.begin(), places.end(), is_on)) continue;
    glm::dvec2 middle(0.0);
    for (const glm::dvec2& at : places) {
      middle += at / static_cast<double>(places.size());
      page.boxes.push_back({at - glm::dvec2(0.5 * MARK), glm::dvec2(MARK)});
    }
    for (std::size_t i = 1; i < places.size(); ++i) page.lines.push_back({places[i - 1], places[i], LINE});
    if (measure.kind == MeasureKind::area) page.lines.push_back({places.back(), places.front(), LINE});
    page.texts.push_back(
        {middle + glm::dvec2(BESIDE, -BESIDE), TEXT_SIZE, TextAnchor::begin, short_text(measure, up)});
  }
}

}  // namespace splatray
