#include "app/library/shot/cut_lines.h"

#include <algorithm>
#include <cmath>

#include "engine/scene/scene_splat.h"

namespace splatray {
namespace {

/// Sine of the least angle between a disc and the plane: what lies nearly in it has no line there.
constexpr double LEAST_SINE = 0.26;
/// The fraction of a disc's radius that is drawn: discs overlap, and reach beyond a surface's borders.
constexpr double DRAWN = 0.9;

/// The distance of a point from a line between two places.
double distance_from(const CutLine& line, const glm::dvec2& point) {
  const glm::dvec2 along = line[1] - line[0], to_point = point - line[0];
  const double length_squared = glm::dot(along, along);
  const double share =
      length_squared > 0.0 ? std::clamp(glm::dot(to_point, along) / length_squared, 0.0, 1.0) : 0.0;
  return glm::distance(to_point, share * along);
}

}  // namespace

std::vector<CutLine> cut_lines(const Scene& scene, const Region& region, const Sheet& sheet) {
  std::vector<CutLine> lines;
  const glm::dvec3& n = sheet.toward;
  for_each_splat(scene, [&](std::size_t, const SceneSplat& splat) {
    const glm::dvec3 center = splat.center_world();
    const double radius = DRAWN * splat.radius_world();
    const double height = glm::dot(n, center) - sheet.near;
    if (std::abs(height) > radius) return;
    const glm::dvec3 normal = splat.normal(), along = glm::cross(normal, n);
    const double sine = glm::length(along);
    if (sine < LEAST_SINE || std::abs(height) > radius * sine) return;
    const double away = -height / sine;
    const glm::dvec3 middle = center + away * (n - glm::dot(n, normal) * normal) / sine;
    // A little inside, where the plane itself is a border of the region.
    if (!region.holds(middle - 1e-6 * radius * n)) return;
    const glm::dvec3 half = std::sqrt(radius * radius - away * away) / sine * along;
    lines.push_back({sheet.on_paper(middle - half), sheet.on_paper(middle + half)});
  });
  return lines;
}

void draw_cut(const Sheet& sheet, const PixelWindow& window, Image& image) {
  if (sheet.cut_lines.empty()) return;
  const double half_width = std::max(0.5 * sheet.asked.weight_mm / sheet.pixel_mm(), 0.5);  // pixels
  std::vector<float> covered(image.rgba.size(), 0.0F);
  const glm::dvec2 first(window.x, window.y);
  for (const CutLine& line : sheet.cut_lines) {
    const CutLine drawn{sheet.pixel_of(line[0]) - first, sheet.pixel_of(line[1]) - first};
    const glm::dvec2 size(image.width, image.height), reach(half_width + 1.0);
    const glm::dvec2 low =
        glm::clamp(glm::floor(glm::min(drawn[0], drawn[1]) - reach), glm::dvec2(0.0), size);
    const glm::dvec2 high =
        glm::clamp(glm::ceil(glm::max(drawn[0], drawn[1]) + reach), glm::dvec2(0.0), size);
    for (auto y = static_cast<std::size_t>(low.y); y < static_cast<std::size_t>(high.y); ++y)
      for (auto x = static_cast<std::size_t>(low.x); x < static_cast<std::size_t>(high.x); ++x) {
        const glm::dvec2 center(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5);
        const auto share =
            static_cast<float>(std::clamp(half_width + 0.5 - distance_from(drawn, center), 0.0, 1.0));
        float& most = covered[y * image.width + x];
        most = std::max(most, share);
      }
  }
  for (std::size_t i = 0; i < covered.size(); ++i) {
    image.rgba[i] = vec4(0.0F, 0.0F, 0.0F, covered[i]) + (1.0F - covered[i]) * image.rgba[i];
  }
}

}  // namespace splatray
