#include "app/view/ui/panels.h"

#include <imgui.h>
#include <imgui_internal.h>

#include "app/view/ui/field_controls.h"
#include "app/view/ui/panel_parts.h"
#include "engine/scene/splat.h"

namespace splatray {
namespace {

constexpr float LABEL_EM = 6.5F;  ///< room to the right of a control for its name

void mode_combo(Document& document) {
  if (!ImGui::BeginCombo("view", view_mode_name(document.mode))) return;
  for (int i = 0; i < VIEW_MODE_COUNT; ++i) {
    const ViewMode mode = static_cast<ViewMode>(i);
    if (ImGui::Selectable(view_mode_name(mode), mode == document.mode)) document.mode = mode;
  }
  ImGui::EndCombo();
}

void toolbar(Requests& requests) {
  command_button("open", Action::open, requests);
  ImGui::SameLine();
  command_button("save", Action::save, requests);
  ImGui::SameLine();
  command_button("sheet", Action::sheet, requests);
  ImGui::SameLine();
  command_button("record", Action::record, requests);
  ImGui::SameLine();
  command_button("copy", Action::copy_command, requests);
  ImGui::SameLine();
  command_button("keys", Action::help, requests);
}

bool section(const char* title, bool open_first) {
  return ImGui::CollapsingHeader(title, open_first ? ImGuiTreeNodeFlags_DefaultOpen : 0);
}

void column(Document& document, PanelState& state, const PanelView& view, Requests& requests) {
  toolbar(requests);
  if (document.materials.empty()) return;
  if (section("Points", document.loaded->is_scan)) {
    if (!document.loaded->color_sources.empty()) attribute_panel(document, view);
    drawing_controls(document);
  }
  if (section("Regions", document.loaded->is_scan)) region_panel(document, state);
  if (section("Measures", document.loaded->is_scan)) measure_panel(document, state);
  if (section("Camera", false)) camera_panel(document, state, requests);
  if (section("Lights", false)) light_panel(document, state);
  if (section("Environment", false)) environment_panel(document);
  if (section("Objects", !document.loaded->is_scan)) object_panel(document, state);
  if (section("Material", !document.loaded->is_scan)) material_panel(document, state);
  if (section("Quality", false)) quality_panel(document, state);
  if (section("Cache", false)) cache_panel(view, requests);
  if (section("All options", false)) all_fields(document, state, requests);
  if (section("Splat under the cursor", false)) inspector_panel(view);
  if (section("Statistics", false)) {
    mode_combo(document);
    statistics_panel(view);
  }
}

void column_window(Document& document, PanelState& state, const PanelView& view, float width_px,
                   Requests& requests) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({display.x - width_px, 0.0F});
  ImGui::SetNextWindowSize({width_px, display.y});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0F);
  constexpr ImGuiWindowFlags FLAGS = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove |
                                     ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoSavedSettings |
                                     ImGuiWindowFlags_NoBringToFrontOnFocus;
  if (ImGui::Begin("##column", nullptr, FLAGS)) {
    ImGui::PushItemWidth(-LABEL_EM * ImGui::GetFontSize());
    column(document, state, view, requests);
    ImGui::PopItemWidth();
  }
  ImGui::End();
  ImGui::PopStyleVar();
}

}  // namespace

bool close_drop_down() {
  const auto& popups = ImGui::GetCurrentContext()->OpenPopupStack;
  if (popups.empty()) return false;
  const ImGuiWindow* top = popups.back().Window;
  if (top == nullptr || (top->Flags & ImGuiWindowFlags_Modal) != 0) return false;
  ImGui::ClosePopupToLevel(popups.Size - 1, true);
  return true;
}

Requests draw_panels(Document& document, PanelState& state, const PanelView& view) {
  Requests requests;
  const float window_px = ImGui::GetIO().DisplaySize.x;
  const float column_px = panel_column_px(state, window_px), picture_px = window_px - column_px;
  if (column_px > 0.0F) column_window(document, state, view, column_px, requests);
  if (document.materials.empty() && view.work == nullptr) welcome(state, picture_px, requests);
  scene_marks(document, state, view, picture_px);
  legend(view, picture_px);
  status_line(document, state, view, picture_px);
  work_bar(view, picture_px, requests);
  help_overlay(state);
  if (state.error.empty()) {
    open_dialog(state, requests);
    save_dialog(document, state, requests);
    sheet_dialog(document, state, requests);
    record_dialog(state, requests);
  }
  error_dialog(state);
  return requests;
}

}  // namespace splatray
