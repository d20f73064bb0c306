#include "app/library/sheet/draw_cut.h"

#include <algorithm>
#include <cmath>

#include "app/library/cut/cut_hatch.h"
#include "app/library/sheet/height_marks.h"
#include "app/library/sheet/page_style.h"
#include "app/library/sheet/seen_lines.h"

namespace splatray {
namespace {

/// Radii of a disc that it reaches over a line at most, where the cut follows from it.
constexpr double OVERHANG = 1.25;

/// A straight part of a line, pixels of the window.
struct Segment {
  glm::dvec2 from, to;
  double half_width;

  [[nodiscard]] double distance(const glm::dvec2& point) const {
    const glm::dvec2 along = to - from, to_point = point - from;
    const double squared = glm::dot(along, along);
    const double share = squared > 0.0 ? std::clamp(glm::dot(to_point, along) / squared, 0.0, 1.0) : 0.0;
    return glm::distance(to_point, share * along);
  }
};

std::vector<Segment> segments_of(const Sheet& sheet, const PixelWindow& window) {
  const glm::dvec2 first(window.x, window.y);
  const auto pixels = [&sheet](double width_mm) { return std::max(0.5 * width_mm / sheet.pixel_mm(), 0.5); };
  std::vector<Segment> segments;
  const auto add_curve = [&](const CutCurve& curve, double width_mm) {
    const std::size_t count = curve.points.size();
    for (std::size_t i = curve.closed ? 0 : 1; i < count; ++i)
      segments.push_back({sheet.pixel_of(curve.points[(i + count - 1) % count]) - first,
                          sheet.pixel_of(curve.points[i]) - first, pixels(width_mm)});
  };
  for (const CutCurve& curve : sheet.beyond) add_curve(curve, SEEN_LINE_MM);
  for (const CutCurve& curve : sheet.overhead)
    for (const CutCurve& dash : dashed(curve, sheet.mm_world())) add_curve(dash, SEEN_LINE_MM);
  for (const CutCurve& curve : sheet.cut_curves) add_curve(curve, sheet.asked.weight_mm);
  for (const Contour& contour : sheet.contours) add_curve(contour.curve, contour_width_mm(sheet, contour));
  for (const auto& [from, to] : sheet.hatch)
    segments.push_back({sheet.pixel_of(from) - first, sheet.pixel_of(to) - first, pixels(FINE_LINE_MM)});
  return segments;
}

/// Keeps in `covered` what the segment covers of each pixel, 0 to 1.
void cover(const Segment& segment, const PixelWindow& window, std::vector<float>& covered) {
  const glm::dvec2 size(window.width, window.height), reach(segment.half_width + 1.0);
  const glm::dvec2 low =
      glm::clamp(glm::floor(glm::min(segment.from, segment.to) - reach), glm::dvec2(0.0), size);
  const glm::dvec2 high =
      glm::clamp(glm::ceil(glm::max(segment.from, segment.to) + reach), glm::dvec2(0.0), size);
  for (auto y = static_cast<std::size_t>(low.y); y < static_cast<std::size_t>(high.y); ++y)
    for (auto x = static_cast<std::size_t>(low.x); x < static_cast<std::size_t>(high.x); ++x) {
      const glm::dvec2 center(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5);
      const double share = std::clamp(segment.half_width + 0.5 - segment.distance(center), 0.0, 1.0);
      float& most = covered[y * window.width + x];
      most = std::max(most, static_cast<float>(share));
    }
}

}  // namespace

void draw_cut(const Sheet& sheet, const PixelWindow& window, Image& image) {
  const std::vector<Segment> segments = segments_of(sheet, window);
  if (segments.empty()) return;
  std::vector<float> covered(image.rgba.size(), 0.0F);
  for (const Segment& segment : segments) cover(segment, window, covered);
  for (std::size_t i = 0; i < covered.size(); ++i)
    image.rgba[i] = vec4(0.0F, 0.0F, 0.0F, covered[i]) + (1.0F - covered[i]) * image.rgba[i];
}

std::vector<float> beside_cut(const Sheet& sheet, const PixelWindow& window) {
  const glm::dvec2 first(window.x, window.y);
  std::vector<float> covered(std::size_t{window.width} * window.height, 0.0F);
  for (const CutCurve& curve : sheet.cut_curves) {
    const std::size_t count = curve.points.size();
    for (std::size_t i = curve.closed ? 0 : 1; i < count; ++i)
      cover({sheet.pixel_of(curve.points[(i + count - 1) % count]) - first,
             sheet.pixel_of(curve.points[i]) - first, OVERHANG * curve.radius / sheet.pixel_world},
            window, covered);
  }
  return covered;
}

void clear_solids(const Sheet& sheet, const PixelWindow& window, Image& image) {
  const HatchStyle rows{sheet.pixel_world, 0.0, sheet.thickest_world, {1.0, 0.0}};
  const glm::dvec2 size(window.width, window.height), first(window.x, window.y);
  for (const auto& [from, to] : cut_hatch(sheet.cut_curves, rows)) {
    // A row's line lies at its border: by so little the cut's own line hides it.
    const glm::dvec2 begin = sheet.pixel_of(from) - first, end = sheet.pixel_of(to) - first;
    const double row = std::round(begin.y);
    if (row < 0.0 || row >= size.y) continue;
    const auto left = static_cast<std::size_t>(std::clamp(std::round(begin.x), 0.0, size.x)),
               right = static_cast<std::size_t>(std::clamp(std::round(end.x), 0.0, size.x));
    for (std::size_t x = left; x < right; ++x)
      image.rgba[static_cast<std::size_t>(row) * window.width + x] = vec4(0.0F);
  }
}

}  // namespace splatray
