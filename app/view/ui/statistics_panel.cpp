#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "app/view/ui/panel_parts.h"
#include "engine/base/number_text.h"

namespace splatray {
namespace {

/// A number as printf writes it.
std::string text(const char* format, double value) {
  std::array<char, 400> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, value);
  return buffer.data();
}

void memory_facts(const PoolBytes& bytes) {
  std::uint64_t sum = 0;
  const auto add = [&sum](const char* name, std::uint64_t size) {
    if (size > 0) fact(name, bytes_text(size));
    sum += size;
  };
  for (std::size_t i = 0; i < POOLS; ++i) add(pool_kinds()[i].name, bytes.pools[i]);
  add("environment", bytes.environment);
  add("frame", bytes.frame);
  fact("memory", bytes_text(sum));
}

/// Rays through pixels a second, by device time.
double primary_rays_a_second(const Frame& frame) {
  const double rays = double(frame.image.width) * frame.image.height * std::max(frame.samples, 1U);
  return frame.stats.trace_ms > 0.0 ? 1e3 * rays / frame.stats.trace_ms : 0.0;
}

/// Decimals that show a length of the splat's size to four digits; float64 has no more than 15.
int decimals_for(double radius_world) {
  const double digits = 4.0 - std::floor(std::log10(radius_world));
  return std::isfinite(digits) ? static_cast<int>(std::clamp(digits, 0.0, 15.0)) : 15;
}

void vector_facts(const char* what, const glm::dvec3& v, int decimals) {
  static constexpr std::array AXES = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis) {
    std::array<char, 400> number{};
    std::snprintf(number.data(), number.size(), "%s %+.*f", AXES[static_cast<std::size_t>(axis)], decimals,
                  v[axis]);
    fact(axis == 0 ? what : "", number.data());
  }
}

}  // namespace

void cache_panel(const PanelView& view, Requests& requests) {
  fact("scenes made", text("%.1f MB", 1e-6 * static_cast<double>(view.cache_bytes)));
  command_button("empty the cache", Action::empty_cache, requests);
}

void statistics_panel(const PanelView& view) {
  if (view.frame == nullptr) return;
  const Frame& frame = *view.frame;
  ImGui::TextWrapped("%s", frame.device.c_str());
  fact("pictures", text("%.1f a second", view.frames_per_second));
  fact("last pass", text("%.1f ms", frame.ms));
  fact("tracing", text("%.1f ms in all", frame.stats.trace_ms));
  fact("primary rays", text("%.2f million a second", 1e-6 * primary_rays_a_second(frame)));
  fact("samples", std::to_string(frame.samples) + " a pixel");
  fact("traced", std::to_string(frame.image.width) + " x " + std::to_string(frame.image.height) +
                     text(", scale %.2f", frame.scale));
  ImGui::Separator();
  memory_facts(frame.pool_bytes);
  fact("uploads", std::to_string(frame.pools_uploaded) + " of the pools");
}

void inspector_panel(const PanelView& view) {
  if (view.inspected == nullptr) {
    ImGui::TextDisabled("click a splat");
    return;
  }
  const Inspected& splat = *view.inspected;
  const int decimals = decimals_for(splat.radius_world);
  fact("object", splat.object_name.empty() ? std::to_string(splat.object)
                                           : splat.object_name + " (" + std::to_string(splat.object) + ")");
  vector_facts("centre", splat.center_world, decimals);
  vector_facts("normal", splat.normal, 4);
  fact("radius", text("%.6g", splat.radius_world));
  fact("leaf depth", std::to_string(splat.leaf_depth));
  fact("splats in leaf", std::to_string(splat.leaf_references));
  vector_facts("surface", splat.hit_world, decimals);
  fact("distance", text("%.9g", splat.distance_world));
  for (const AttributeValue& attribute : splat.attributes) fact(attribute.name.c_str(), attribute.text);
}

}  // namespace splatray
