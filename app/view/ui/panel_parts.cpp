#include "app/view/ui/panel_parts.h"

#include <imgui.h>

#include <algorithm>
#include <glm/gtc/color_space.hpp>

namespace splatray {
namespace {

/// "S, Ctrl+S: save the picture" for the tip of a button.
std::string words_of(Action action) {
  std::string names, does;
  for (const Binding& binding : bindings()) {
    if (binding.action != action) continue;
    names += (names.empty() ? "" : ", ") + binding_name(binding);
    if (does.empty()) does = binding.does;
  }
  return does.empty() ? names : names + ": " + does;
}

}  // namespace

void command_button(const char* label, Action action, Requests& requests) {
  if (ImGui::Button(label)) requests.commands.push_back({action});
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", words_of(action).c_str());
}

void recent_list(const PanelState& state, Requests& requests) {
  for (const std::filesystem::path& file : state.recent_files) {
    ImGui::PushID(file.c_str());
    if (ImGui::Selectable(file.filename().c_str())) requests.open = file;
    tip(file.c_str());
    ImGui::PopID();
  }
}

bool color_edit(const char* label, glm::vec3& linear) {
  glm::vec3 seen = glm::convertLinearToSRGB(glm::clamp(linear, 0.0F, 1.0F));
  if (!ImGui::ColorEdit3(label, &seen.x, ImGuiColorEditFlags_Float)) return false;
  linear = glm::convertSRGBToLinear(glm::clamp(seen, 0.0F, 1.0F));
  return true;
}

void tip(const char* text) {
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", text);
}

void fact(const char* what, const std::string& value) {
  ImGui::TextDisabled("%s", what);
  ImGui::SameLine(7.5F * ImGui::GetFontSize());
  ImGui::TextUnformatted(value.c_str());
}

}  // namespace splatray
