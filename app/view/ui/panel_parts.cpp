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
  for (const SceneFiles& files : state.recent_files) {
    std::string paths;
    for (const std::filesystem::path& file : files) paths += (paths.empty() ? "" : "\n") + file.string();
    ImGui::PushID(paths.c_str());
    if (ImGui::Selectable(scene_title(files).c_str())) requests.open = files;
    tip(paths.c_str());
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
  const float em = ImGui::GetFontSize(), end = ImGui::GetItemRectMax().x - ImGui::GetWindowPos().x;
  ImGui::SameLine(std::max(7.5F * em, end + 0.5F * em));
  ImGui::TextUnformatted(value.c_str());
}

}  // namespace splatray
