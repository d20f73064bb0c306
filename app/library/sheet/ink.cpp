#include "app/library/sheet/ink.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "app/library/sheet/draw_cut.h"
#include "app/library/sheet/edges.h"
#include "app/library/sheet/page_style.h"

namespace splatray {
namespace {

constexpr float CREASE_INK = 0.6F;

/// How much of a line is between a pixel and the next one at (dx, dy).
float ink_between(const Edges& edges, std::size_t a, std::size_t b, float dx, float dy) {
  const float step = edges.step(a, b, dx, dy);
  if (step > EDGE_STEP) return 1.0F;
  return edges.show_one(a, b) && edges.cosine(a, b) < CREASE_COSINE ? CREASE_INK : 0.0F;
}

/// How far around a pixel a line on it reaches.
std::uint32_t reach_px(const Sheet& sheet) {
  return static_cast<std::uint32_t>(std::max(std::lround((SEEN_LINE_MM / sheet.pixel_mm() - 1.0) / 2.0), 0L));
}

/// Lines one pixel wide, 0 to 1 for each.
std::vector<float> thin_lines(const Sheet& sheet, const SeenPixels& seen) {
  const Edges edges(sheet, seen.aov);
  const std::size_t width = seen.window.width, height = seen.window.height;
  std::vector<float> ink(seen.aov.size(), 0.0F);
  const auto mark = [&](std::size_t a, std::size_t b, float amount) {
    // On the nearer side: what is seen before the other has the outline.
    const bool near_a = !(seen.aov[a].z > seen.aov[b].z);
    float& most = ink[near_a ? a : b];
    most = std::max(most, amount);
  };
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t at = y * width + x;
      if (x + 1 < width) mark(at, at + 1, ink_between(edges, at, at + 1, 1.0F, 0.0F));
      if (y + 1 < height) mark(at, at + width, ink_between(edges, at, at + width, 0.0F, -1.0F));
    }
  return ink;
}

}  // namespace

PixelWindow ink_window(const Sheet& sheet, const PixelWindow& part) {
  const std::uint32_t around = reach_px(sheet) + 1;
  PixelWindow window;
  window.x = part.x - std::min(part.x, around);
  window.y = part.y - std::min(part.y, around);
  window.width = std::min(part.x + part.width + around, sheet.width) - window.x;
  window.height = std::min(part.y + part.height + around, sheet.height) - window.y;
  return window;
}

void draw_ink(const Sheet& sheet, const SeenPixels& seen, const PixelWindow& part, Image& image) {
  std::vector<float> ink = thin_lines(sheet, seen);
  const std::vector<float> beside = beside_cut(sheet, seen.window);
  for (std::size_t i = 0; i < ink.size(); ++i) ink[i] *= 1.0F - beside[i];
  const std::size_t width = seen.window.width, height = seen.window.height;
  const std::size_t left = part.x - seen.window.x, top = part.y - seen.window.y, reach = reach_px(sheet);
  const auto widest = [&](std::size_t x, std::size_t y) {
    float most = 0.0F;
    for (std::size_t row = y - std::min(y, reach); row <= std::min(y + reach, height - 1); ++row)
      for (std::size_t column = x - std::min(x, reach); column <= std::min(x + reach, width - 1); ++column)
        most = std::max(most, ink[row * width + column]);
    return most;
  };
  for (std::size_t y = 0; y < image.height; ++y)
    for (std::size_t x = 0; x < image.width; ++x) {
      const float amount = widest(left + x, top + y);
      vec4& pixel = image.rgba[y * image.width + x];
      pixel = vec4(0.0F, 0.0F, 0.0F, amount) + (1.0F - amount) * pixel;
    }
}

}  // namespace splatray
