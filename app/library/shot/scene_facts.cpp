#include "app/library/shot/scene_facts.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/rank.h"
#include "engine/image/point_sample.h"
#include "engine/scene/scene_splat.h"

namespace splatray {
namespace {

constexpr std::size_t SAMPLED = 1U << 16;  ///< values that decide whether an attribute says something
constexpr double OUTSIDE = 0.02;           ///< of the values at each end
constexpr std::uint8_t FEW_STEPS = 10;     ///< of 255 in each channel: one colour
constexpr double FEW_SHARE = 0.02;         ///< of the range, between the quartiles: one value

/// The values that leave a share out at each end.
template <class Value>
std::array<Value, 2> middle_of(std::vector<Value>& values, double outside) {
  return {value_at(values, outside), value_at(values, 1.0 - outside)};
}

bool has_colors(const Scene& scene) {
  if (scene.color_pool.empty()) return false;
  const std::size_t stride = scene.color_pool.size() / SAMPLED + 1;
  for (unsigned channel = 0; channel < 3; ++channel) {
    std::vector<std::uint8_t> values;
    for (std::size_t i = 0; i < scene.color_pool.size(); i += stride)
      values.push_back(static_cast<std::uint8_t>(scene.color_pool[i] >> (8 * channel)));
    const auto [low, high] = middle_of(values, OUTSIDE);
    if (high - low > FEW_STEPS) return true;
  }
  return false;
}

/// Whether colours show normals, half of a channel's range and the other half times their component, as programs export them: they
/// say nothing of how bright the surface is. To NORMAL_STEPS of 255, of most splats; normals may be turned.
bool are_normals(const Scene& scene) {
  constexpr double NORMAL_STEPS = 24.0, MOST = 0.75;
  if (scene.color_pool.empty()) return false;
  std::size_t tried = 0, alike = 0;
  for_each_splat(
      scene,
      [&](std::size_t i, const SceneSplat& splat) {
        const std::uint32_t word = scene.color_pool[i];
        const glm::dvec3 color(word & 255U, word >> 8U & 255U, word >> 16U & 255U);
        const glm::dvec3 shown = color - 127.5, normal = 127.5 * splat.normal();
        const auto is_near = [&](const glm::dvec3& other) {
          return glm::all(glm::lessThan(glm::abs(shown - other), glm::dvec3(NORMAL_STEPS)));
        };
        ++tried;
        alike += is_near(normal) || is_near(-normal) ? 1 : 0;
      },
      scene.color_pool.size() / SAMPLED + 1);
  return static_cast<double>(alike) > MOST * static_cast<double>(tried);
}

bool has_intensity(const Scene& scene) {
  const Column* column = find_column(scene.columns, COLUMN_INTENSITY);
  if (column == nullptr || column->size() == 0) return false;
  std::vector<double> values;
  for (std::size_t i = 0; i < column->size(); i += column->size() / SAMPLED + 1)
    if (std::isfinite(column->number(i))) values.push_back(column->number(i));
  if (values.empty()) return false;
  const auto [low, high] = middle_of(values, OUTSIDE);
  const auto [first, last] = middle_of(values, 0.25);
  return high > low && last - first > FEW_SHARE * (high - low);
}

/// Land lies flat and is looked at along it: what lies flat below a camera is a table.
bool sees_land(const Scene& scene, SceneKind kind) {
  constexpr double LEVEL = 0.34;  // sine of 20 degrees
  if (kind != SceneKind::camera) return kind == SceneKind::sweep;
  const glm::dmat3 axes = upright_axes(scene.up);
  const Camera camera = viewpoint_camera(scene, Viewpoint::sensor, 1.0, {});
  const double rise = glm::dot(glm::normalize(camera.target - camera.eye), axes[1]);
  return std::abs(rise) < LEVEL && is_flat(main_parts(sample_points(scene)), axes);
}

}  // namespace

SceneFacts facts_of(const Scene& scene) {
  SceneFacts facts;
  facts.kind = kind_of_scan(scene);
  facts.views = check_views(scene, facts.kind, choose_viewpoint(scene));
  facts.viewpoint = facts.views.back().viewpoint;
  if (facts.kind == SceneKind::none) return facts;
  facts.sees_land = sees_land(scene, facts.kind);
  facts.shows_normals = are_normals(scene);
  facts.has_colors = has_colors(scene) && !facts.shows_normals;
  facts.has_intensity = has_intensity(scene);
  return facts;
}

}  // namespace splatray
