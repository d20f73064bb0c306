#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/view/model/navigation.h"
#include "app/view/ui/panel_parts.h"

namespace splatray {
namespace {

using std::numbers::pi;

constexpr std::size_t MOST_LIGHTS = 64;
constexpr double POINT_DISTANCE_RADII = 2.0;  ///< of a new point light from the scene's centre
constexpr float MOST_STRENGTH = 1e30F;
constexpr double NEW_CONE = pi / 6.0;  ///< of a new spot

/// Over the viewer's shoulder, the direction of new lights.
glm::dvec3 shoulder(const Document& document) {
  const glm::dvec3 back = document.camera.eye - document.camera.target;
  const double distance = glm::length(back);
  const glm::dvec3 up = glm::normalize(up_of(document));
  return distance > 0.0 ? glm::normalize(back / distance + up) : up;
}

/// A light that gives the scene's centre an irradiance of pi: white matte surfaces facing it look white.
SceneLight new_light(const Document& document, std::uint32_t kind) {
  SceneLight light;
  light.kind = kind;
  light.power = glm::vec3(std::numbers::pi_v<float>);
  light.position = shoulder(document);
  if (kind == LIGHT_POINT) {
    const double distance = POINT_DISTANCE_RADII * scene_radius_world(document);
    light.position =
        0.5 * (document.bounds_min_world + document.bounds_max_world) + distance * light.position;
    light.power *= static_cast<float>(distance * distance);
  }
  return light;
}

void add_button(const char* label, std::uint32_t kind, Document& document, PanelState& state) {
  std::vector<LightRequest>& lights = lights_of(document);
  if (!ImGui::Button(label) || lights.size() >= MOST_LIGHTS) return;
  lights.push_back({new_light(document, kind), {}, /*has_power=*/true});
  state.light = static_cast<std::uint32_t>(lights.size() - 1);
}

/// It shines at the scene's centre.
void add_spot_button(Document& document, PanelState& state) {
  const std::size_t before = lights_of(document).size();
  add_button("add spot", LIGHT_POINT, document, state);
  if (lights_of(document).size() == before) return;
  SceneLight& light = lights_of(document).back().light;
  light.spot_axis =
      glm::normalize(0.5 * (document.bounds_min_world + document.bounds_max_world) - light.position);
  light.spot_outer = NEW_CONE;
}

void angle_control(const char* label, double least, double most, double& radians) {
  auto angle = static_cast<float>(radians);
  if (ImGui::SliderAngle(label, &angle, static_cast<float>(glm::degrees(least)),
                         static_cast<float>(glm::degrees(most)), "%.1f\u00B0", ImGuiSliderFlags_AlwaysClamp))
    radians = std::clamp(static_cast<double>(angle), least, most);
}

/// Controls how far a point light shines, and where a spot shines to.
void reach_controls(const Document& document, SceneLight& light) {
  const auto speed = static_cast<float>(scene_radius_world(document) / 200.0);
  const double nothing = 0.0;
  ImGui::DragScalar("range", ImGuiDataType_Double, &light.range, speed, &nothing, nullptr, "%.5g");
  light.range = std::max(light.range, 0.0);
  tip("how far it shines, world units; 0: as far as there is anything");
  if (!is_spot(light)) return;
  constexpr double NARROW = 1e-3, WIDE = 0.5 * pi;
  angle_control("cone", NARROW, WIDE, light.spot_outer);
  light.spot_inner = std::min(light.spot_inner, light.spot_outer - 0.5 * NARROW);
  angle_control("inner cone", 0.0, light.spot_outer - 0.5 * NARROW, light.spot_inner);
  glm::dvec3 target = light.position + scene_radius_world(document) * glm::normalize(light.spot_axis);
  if (ImGui::DragScalarN("shines at", ImGuiDataType_Double, &target.x, 3, speed, nullptr, nullptr, "%.5g") &&
      glm::distance(target, light.position) > 0.0)
    light.spot_axis = glm::normalize(target - light.position);
}

void light_list(const std::vector<LightRequest>& lights, PanelState& state) {
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const SceneLight& light = lights[i].light;
    const std::string name = std::string(light_kind_name(light)) + " " + std::to_string(i + 1);
    if (ImGui::Selectable(name.c_str(), state.light == i)) state.light = static_cast<std::uint32_t>(i);
  }
}

void point_controls(const Document& document, SceneLight& light) {
  const float speed = static_cast<float>(scene_radius_world(document) / 200.0);
  ImGui::DragScalarN("position", ImGuiDataType_Double, &light.position.x, 3, speed, nullptr, nullptr, "%.5g");
}

void sun_controls(const Document& document, SceneLight& light) {
  const glm::dmat3 axes = upright_axes(up_of(document));
  const glm::dvec3 local = glm::transpose(axes) * glm::normalize(light.position);
  float azimuth = static_cast<float>(std::atan2(local.x, local.z));
  float elevation = static_cast<float>(std::asin(std::clamp(local.y, -1.0, 1.0)));
  bool changed = ImGui::SliderAngle("azimuth", &azimuth, -180.0F, 180.0F, "%.0f\u00B0");
  changed |= ImGui::SliderAngle("elevation", &elevation, -89.0F, 89.0F, "%.0f\u00B0");
  if (!changed) return;
  const double level = std::cos(double(elevation));
  light.position = axes * glm::dvec3(level * std::sin(double(azimuth)), std::sin(double(elevation)),
                                     level * std::cos(double(azimuth)));
}

/// Controls the size of a light, which path tracing alone sees.
void size_controls(const Document& document, SceneLight& light) {
  if (is_flat(light.kind)) return;
  if (light.kind == LIGHT_POINT) {
    const double least = 0.0, most = scene_radius_world(document);
    ImGui::SliderScalar("radius", ImGuiDataType_Double, &light.size, &least, &most, "%.4g",
                        ImGuiSliderFlags_AlwaysClamp);
    return;
  }
  float degrees = static_cast<float>(light.size * 360.0 / pi);
  if (ImGui::SliderFloat("angle", &degrees, 0.0F, 60.0F, "%.2f\u00B0", ImGuiSliderFlags_AlwaysClamp))
    light.size = degrees * pi / 360.0;
  tip("how large the sun seems");
}

void power_controls(SceneLight& light) {
  float strength = std::max({light.power.x, light.power.y, light.power.z});
  glm::vec3 color = strength > 0.0F ? light.power / strength : glm::vec3(1.0F);
  bool changed = color_edit("colour", color);
  const float speed = std::max(0.01F * strength, 1e-3F);
  changed |= ImGui::DragFloat("strength", &strength, speed, 0.0F, MOST_STRENGTH, "%.4g",
                              ImGuiSliderFlags_AlwaysClamp);
  tip(light.kind == LIGHT_POINT ? "intensity: irradiance times distance squared"
                                : "irradiance facing the sun");
  if (changed) light.power = strength * color;
}

}  // namespace

void light_panel(Document& document, PanelState& state) {
  add_button("add sun", LIGHT_DIRECTIONAL, document, state);
  ImGui::SameLine();
  add_button("add point light", LIGHT_POINT, document, state);
  ImGui::SameLine();
  add_spot_button(document, state);
  std::vector<LightRequest>& lights = lights_of(document);
  light_list(lights, state);
  if (lights.empty()) return;
  state.light = std::min(state.light, static_cast<std::uint32_t>(lights.size() - 1));
  SceneLight& light = lights[state.light].light;
  ImGui::PushID(static_cast<int>(state.light));
  light.kind == LIGHT_DIRECTIONAL ? sun_controls(document, light) : point_controls(document, light);
  if (light.kind == LIGHT_POINT) reach_controls(document, light);
  if (look_of(document) != LOOK_PAPER) size_controls(document, light);
  power_controls(light);
  if (ImGui::Button("remove")) lights.erase(lights.begin() + state.light);
  ImGui::PopID();
}

}  // namespace splatray
