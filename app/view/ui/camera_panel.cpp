#include <imgui.h>

#include <array>
#include <cfloat>
#include <cmath>
#include <cstdio>
#include <string>

#include "app/view/model/navigation.h"
#include "app/view/ui/panel_parts.h"

namespace splatray {
namespace {

constexpr double LEAST_FOV_DEG = 1.0, MOST_FOV_DEG = 150.0;

void axis_buttons(Requests& requests) {
  struct Labelled {
    const char* label;
    Action action;
  };
  static constexpr std::array VIEWS = {
      Labelled{"front", Action::view_front}, Labelled{"right", Action::view_right},
      Labelled{"top", Action::view_top},     Labelled{"back", Action::view_back},
      Labelled{"left", Action::view_left},   Labelled{"below", Action::view_bottom}};
  for (std::size_t i = 0; i < VIEWS.size(); ++i) {
    if (i % 3 != 0) ImGui::SameLine();
    command_button(VIEWS[i].label, VIEWS[i].action, requests);
  }
}

void viewpoint_buttons(Requests& requests) {
  command_button("oblique", Action::view_oblique, requests);
  ImGui::SameLine();
  command_button("inside", Action::view_inside, requests);
  ImGui::SameLine();
  command_button("dollhouse", Action::view_dollhouse, requests);
  ImGui::SameLine();
  command_button("sensor", Action::view_sensor, requests);
}

void up_axis_buttons(Document& document) {
  static constexpr std::array NAMES = {"x", "y", "z"};
  ImGui::TextUnformatted("up");
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 up(0.0);
    up[axis] = 1.0;
    ImGui::SameLine();
    if (ImGui::RadioButton(NAMES[static_cast<std::size_t>(axis)], up_of(document) == up))
      set_up_axis(document, up);
  }
}

/// A click goes to a bookmark that is set and sets one that is not; a right click sets it.
void bookmark_buttons(const PanelState& state, Requests& requests) {
  ImGui::TextUnformatted("bookmarks");
  for (int digit = 1; digit <= BOOKMARK_COUNT; ++digit) {
    const bool is_set = state.bookmarks[static_cast<std::size_t>(digit - 1)].has_value();
    ImGui::PushStyleVar(ImGuiStyleVar_Alpha, is_set ? 1.0F : 0.5F);
    const bool clicked = ImGui::SmallButton(std::to_string(digit).c_str());
    ImGui::PopStyleVar();
    const bool sets = ImGui::IsItemClicked(ImGuiMouseButton_Right) || (clicked && !is_set);
    tip(is_set ? "click: go there; right click: remember this camera instead" : "remember this camera");
    if (sets) requests.commands.push_back({Action::bookmark_set, digit});
    if (clicked && is_set) requests.commands.push_back({Action::bookmark_go, digit});
    if (digit != BOOKMARK_COUNT) ImGui::SameLine();
  }
}

constexpr const char* COORDINATE = "%.12g";

/// Whether three numbers fit beside each other into a width.
bool fit_beside(const glm::dvec3& point, float width_px) {
  const ImGuiStyle& style = ImGui::GetStyle();
  // Dear ImGui gives each the same number of whole pixels.
  const float each =
      std::floor((width_px - 2.0F * style.ItemInnerSpacing.x) / 3.0F) - 2.0F * style.FramePadding.x;
  for (int axis = 0; axis < 3; ++axis) {
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), COORDINATE, point[axis]);
    if (ImGui::CalcTextSize(text.data()).x > each) return false;
  }
  return true;
}

/// Three numbers that are taken over one by one when Enter ends them; below each other where they are long.
void point_input(const char* label, glm::dvec3& point) {
  glm::dvec3 typed = point;
  ImGui::TextUnformatted(label);
  ImGui::PushID(label);
  const int columns = fit_beside(point, ImGui::GetContentRegionAvail().x) ? 3 : 1;
  for (int axis = 0; axis < 3; axis += columns) {
    ImGui::PushID(axis);
    ImGui::SetNextItemWidth(-FLT_MIN);  // to the right end
    if (ImGui::InputScalarN("##numbers", ImGuiDataType_Double, &typed[axis], columns, nullptr, nullptr,
                            COORDINATE, ImGuiInputTextFlags_EnterReturnsTrue))
      point = typed;
    ImGui::PopID();
  }
  ImGui::PopID();
}

}  // namespace

void camera_panel(Document& document, PanelState& state, Requests& requests) {
  command_button("frame all", Action::frame_all, requests);
  ImGui::SameLine();
  command_button("as loaded", Action::home, requests);
  axis_buttons(requests);
  viewpoint_buttons(requests);
  ImGui::Checkbox("walk", &state.walks);
  tip("W, A, S, D, Q, E move along the ground; the wheel changes the speed");
  if (state.walks) {
    const double slowest = 1e-3, fastest = 1e3;
    ImGui::SliderScalar("walk speed", ImGuiDataType_Double, &state.walk_speed, &slowest, &fastest, "%.3g",
                        ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic);
  }
  bool ortho = document.camera.ortho_height > 0.0;
  if (ImGui::Checkbox("orthographic", &ortho)) toggle_orthographic(document);
  if (document.camera.ortho_height == 0.0)
    ImGui::SliderScalar("field of view", ImGuiDataType_Double, &document.camera.fov_y_deg, &LEAST_FOV_DEG,
                        &MOST_FOV_DEG, "%.1f\u00B0", ImGuiSliderFlags_AlwaysClamp);
  up_axis_buttons(document);
  bookmark_buttons(state, requests);
  point_input("eye", document.camera.eye);
  point_input("pivot", document.camera.target);
}

}  // namespace splatray
