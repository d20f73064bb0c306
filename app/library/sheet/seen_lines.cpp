#include "app/library/sheet/seen_lines.h"

#include <algorithm>
#include <cmath>

#include "app/library/cut/cut_join.h"
#include "app/library/cut/line_bridge.h"
#include "app/library/cut/line_doubles.h"
#include "app/library/cut/pixel_borders.h"
#include "app/library/cut/polyline_fit.h"
#include "app/library/sheet/draw_cut.h"
#include "app/library/sheet/edges.h"
#include "app/library/sheet/page_style.h"
#include "engine/base/all_cores.h"

namespace splatray {
namespace {

constexpr float WEAK_STEP = 3.0F;        ///< of depth, pixels, that goes on with a line
constexpr double TOLERANCE_DISCS = 1.0;  ///< radii that rims wander by
/// Between the steps of a line of pixels, whose middles are half a pixel off.
constexpr double TOLERANCE_PX = 1.25;
constexpr double LEAST_MM = 2.0;     ///< of a line on paper
constexpr double LEAST_DISCS = 8.0;  ///< and in radii: four discs side by side
constexpr double LEAST_PART = 0.25;  ///< of that: of a piece of a line
constexpr float BESIDE = 0.5F;       ///< of a pixel that lies beside what is cut

/// Pixels that a disc's radius takes.
std::uint32_t disc_pixels(const Sheet& sheet) {
  return static_cast<std::uint32_t>(std::clamp(std::round(sheet.disc_world / sheet.pixel_world), 1.0, 8.0));
}

/// What is seen, near steps of depth that of the median depth of all within half a disc's radius: what is narrower is none of the surface's,
/// as single discs that lean out of a narrow face.
class StepFilter {
 public:
  StepFilter(const Sheet& sheet, std::span<const AovPixel> aov)
      : width_(sheet.width), height_(sheet.height), reach_(disc_pixels(sheet) / 2), aov_(aov) {
    const Edges edges(sheet, aov);
    near_step_.resize(aov.size());
    for (std::size_t y = 0; y < height_; ++y)
      for (std::size_t x = 0; x < width_; ++x) {
        const std::size_t at = y * width_ + x;
        const bool right = x + 1 < width_ && edges.step(at, at + 1, 1.0F, 0.0F) > WEAK_STEP;
        const bool below = y + 1 < height_ && edges.step(at, at + width_, 0.0F, -1.0F) > WEAK_STEP;
        if (right || below) for_each_near(x, y, [this](std::size_t pixel) { near_step_[pixel] = true; });
      }
  }

  [[nodiscard]] std::vector<AovPixel> run() const {
    std::vector<AovPixel> filtered(aov_.begin(), aov_.end());
    on_all_cores(height_, [&](std::size_t y) {
      std::vector<std::size_t> near;
      for (std::size_t x = 0; x < width_; ++x) {
        if (!near_step_[y * width_ + x]) continue;
        near.clear();
        for_each_near(x, y, [&near](std::size_t pixel) { near.push_back(pixel); });
        filtered[y * width_ + x] = aov_[median(near)];
      }
    });
    return filtered;
  }

 private:
  template <typename Visit>
  void for_each_near(std::size_t x, std::size_t y, const Visit& visit) const {
    for (std::size_t row = y - std::min(y, reach_); row <= std::min(y + reach_, height_ - 1); ++row)
      for (std::size_t column = x - std::min(x, reach_); column <= std::min(x + reach_, width_ - 1); ++column)
        visit(row * width_ + column);
  }
  [[nodiscard]] std::size_t median(std::vector<std::size_t>& near) const {
    const auto middle = near.begin() + static_cast<std::ptrdiff_t>(near.size() / 2);
    std::nth_element(near.begin(), middle, near.end(),
                     [this](std::size_t a, std::size_t b) { return aov_[a].z < aov_[b].z; });
    return *middle;
  }

  std::size_t width_, height_, reach_;
  std::span<const AovPixel> aov_;
  std::vector<bool> near_step_;
};

/// Marks the borders between pixels that lines are made of.
class BorderMarker {
 public:
  BorderMarker(const Sheet& sheet, std::span<const AovPixel> aov)
      : sheet_(sheet),
        edges_(sheet, aov),
        beside_(beside_cut(sheet, {0, 0, sheet.width, sheet.height})),
        // Normals are blended over a disc: a crease is seen from one side of it to the other.
        reach_(disc_pixels(sheet)) {}

  PixelBorders run() const {
    PixelBorders borders(sheet_.width, sheet_.height);
    for (std::uint32_t y = 0; y < sheet_.height; ++y)
      for (std::uint32_t x = 0; x < sheet_.width; ++x) {
        if (x + 1 < sheet_.width) borders.mark_right(x, y, mark(x, y, true));
        if (y + 1 < sheet_.height) borders.mark_below(x, y, mark(x, y, false));
      }
    return borders;
  }

 private:
  [[nodiscard]] PixelBorders::Mark mark(std::uint32_t x, std::uint32_t y, bool is_right) const {
    const std::size_t at = std::size_t{y} * sheet_.width + x, stride = is_right ? 1 : sheet_.width;
    if (std::max(beside_[at], beside_[at + stride]) > BESIDE) return PixelBorders::none;
    const float dx = is_right ? 1.0F : 0.0F, dy = is_right ? 0.0F : -1.0F;
    const float step = edges_.step(at, at + stride, dx, dy);
    if (step > EDGE_STEP) return PixelBorders::strong;
    if (step > WEAK_STEP) return PixelBorders::weak;
    const std::uint32_t place = is_right ? x : y, count = is_right ? sheet_.width : sheet_.height;
    if (place < reach_ || place + 1 + reach_ >= count) return PixelBorders::none;
    return is_crease(at, stride, dx, dy) ? PixelBorders::strong : PixelBorders::none;
  }

  /// Whether the surfaces a disc before the border and behind it meet in it, and none of the pixels between steps.
  [[nodiscard]] bool is_crease(std::size_t at, std::size_t stride, float dx, float dy) const {
    const std::size_t first = at - reach_ * stride, last = at + (1 + reach_) * stride;
    if (!edges_.show_one(first, last) || edges_.cosine(first, last) >= CREASE_COSINE) return false;
    const auto length = static_cast<float>(2 * reach_ + 1);
    const float place = edges_.crease(first, last, length * dx, length * dy) * length;
    const float middle = 0.5F * length;
    if (!(place >= middle - 0.5F && place < middle + 0.5F)) return false;
    for (std::size_t pixel = first; pixel < last; pixel += stride)
      if (edges_.step(pixel, pixel + stride, dx, dy) > WEAK_STEP) return false;
    return true;
  }

  const Sheet& sheet_;
  Edges edges_;
  std::vector<float> beside_;
  std::uint32_t reach_;  ///< pixels
};

}  // namespace

std::vector<CutCurve> seen_lines(const Sheet& sheet, std::span<const AovPixel> aov) {
  const double disc = sheet.disc_world / sheet.pixel_world,
               tolerance = std::max(TOLERANCE_PX, TOLERANCE_DISCS * disc);
  const double least = std::max(LEAST_MM * sheet.mm_world(), LEAST_DISCS * sheet.disc_world);
  const auto spur = static_cast<std::size_t>(std::ceil(4.0 * tolerance));
  std::vector<CutCurve> curves;
  const std::vector<AovPixel> filtered = StepFilter(sheet, aov).run();
  for (const BorderLine& line : BorderMarker(sheet, filtered).run().lines(spur)) {
    CutCurve curve{fitted_polyline(line.points, line.closed, tolerance), line.closed};
    for (glm::dvec2& point : curve.points)
      point = sheet.corner + point * sheet.pixel_world * glm::dvec2(1.0, -1.0);
    if (curve.points.size() > 1 && curve_length(curve) >= LEAST_PART * least)
      curves.push_back(std::move(curve));
  }
  const double tolerance_world = tolerance * sheet.pixel_world;
  curves = bridged(curves, {least, tolerance_world});
  std::erase_if(curves, [least](const CutCurve& curve) { return curve_length(curve) < least; });
  curves = without_doubles(std::move(curves), tolerance_world);
  for (CutCurve& curve : curves) curve = simplified(curve, 0.5 * tolerance_world);
  return curves;
}

Sheet overhead_sheet(const Sheet& sheet) {
  Sheet above = sheet;
  above.right = -sheet.right;
  above.toward = -sheet.toward;
  above.corner.x = -(sheet.corner.x + sheet.width * sheet.pixel_world);
  above.near = -sheet.near;
  above.far = above.near - (sheet.near - sheet.far);
  above.asked.depth.reset();
  above.cut_curves = mirrored(sheet.cut_curves);
  return above;
}

std::vector<CutCurve> mirrored(std::vector<CutCurve> curves) {
  for (CutCurve& curve : curves)
    for (glm::dvec2& point : curve.points) point.x = -point.x;
  return curves;
}

std::vector<CutCurve> dashed(const CutCurve& curve, double mm_world) {
  const double dash = DASH_MM * mm_world, gap = DASH_GAP_MM * mm_world;
  std::vector<glm::dvec2> points = curve.points;
  if (curve.closed) points.push_back(points.front());
  std::vector<CutCurve> dashes;
  bool is_drawn = false;
  double left = 0.0;  // of the dash or gap
  for (std::size_t i = 1; i < points.size(); ++i) {
    const glm::dvec2 way = points[i] - points[i - 1];
    const double length = glm::length(way);
    double at = 0.0;
    while (at < length) {
      if (left <= 0.0) {
        is_drawn = !is_drawn;
        left = is_drawn ? dash : gap;
        if (is_drawn) dashes.push_back({{points[i - 1] + at / length * way}, false});
      }
      const double on = std::min(left, length - at);
      at += on;
      left -= on;
      if (is_drawn) dashes.back().points.push_back(points[i - 1] + at / length * way);
    }
  }
  return dashes;
}

}  // namespace splatray
