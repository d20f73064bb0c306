#include "app/library/sheet/draw_cut.h"

#include <algorithm>
#include <cmath>

#include "app/library/sheet/height_marks.h"
#include "app/library/sheet/page_style.h"

namespace splatray {
namespace {

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
  for (const CutCurve& curve : sheet.cut_curves) add_curve(curve, sheet.asked.weight_mm);
  for (const Contour& contour : sheet.contours) add_curve(contour.curve, contour_width_mm(sheet, contour));
  for (const auto& [from, to] : sheet.hatch)
    segments.push_back({sheet.pixel_of(from) - first, sheet.pixel_of(to) - first, pixels(FINE_LINE_MM)});
  return segments;
}

/// Keeps in `covered` what the segment covers of each pixel, 0 to 1.
void cover(const Segment& segment, const Image& image, std::vector<float>& covered) {
  const glm::dvec2 size(image.width, image.height), reach(segment.half_width + 1.0);
  const glm::dvec2 low =
      glm::clamp(glm::floor(glm::min(segment.from, segment.to) - reach), glm::dvec2(0.0), size);
  const glm::dvec2 high =
      glm::clamp(glm::ceil(glm::max(segment.from, segment.to) + reach), glm::dvec2(0.0), size);
  for (auto y = static_cast<std::size_t>(low.y); y < static_cast<std::size_t>(high.y); ++y)
    for (auto x = static_cast<std::size_t>(low.x); x < static_cast<std::size_t>(high.x); ++x) {
      const glm::dvec2 center(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5);
      const double share = std::clamp(segment.half_width + 0.5 - segment.distance(center), 0.0, 1.0);
      float& most = covered[y * image.width + x];
      most = std::max(most, static_cast<float>(share));
    }
}

}  // namespace

void draw_cut(const Sheet& sheet, const PixelWindow& window, Image& image) {
  if (sheet.cut_curves.empty() && sheet.contours.empty()) return;
  std::vector<float> covered(image.rgba.size(), 0.0F);
  for (const Segment& segment : segments_of(sheet, window)) cover(segment, image, covered);
  for (std::size_t i = 0; i < covered.size(); ++i)
    image.rgba[i] = vec4(0.0F, 0.0F, 0.0F, covered[i]) + (1.0F - covered[i]) * image.rgba[i];
}

}  // namespace splatray
