#include "app/view/ui/dialog.h"

#include <imgui.h>

namespace splatray {
namespace {

constexpr float WIDTH_EM = 26.0F, FIELD_EM = 17.0F;

}  // namespace

Dialog::Dialog(const char* title, bool& open) : open_(open) {
  const float em = ImGui::GetFontSize();
  const ImVec2 center = ImGui::GetMainViewport()->GetCenter();
  if (!ImGui::IsPopupOpen(title)) ImGui::OpenPopup(title);
  ImGui::SetNextWindowPos(center, ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowSize({WIDTH_EM * em, 0.0F});
  constexpr ImGuiWindowFlags FLAGS = ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize;
  shown_ = ImGui::BeginPopupModal(title, &open_, FLAGS);
  if (shown_) ImGui::PushItemWidth(FIELD_EM * em);
}

Dialog::~Dialog() {
  if (!shown_) return;
  if (!open_) ImGui::CloseCurrentPopup();
  ImGui::PopItemWidth();
  ImGui::EndPopup();
}

bool Dialog::done_or_cancelled(const char* verb, const std::string& refusal) {
  if (!refusal.empty()) ImGui::TextWrapped("%s", refusal.c_str());
  ImGui::Spacing();
  ImGui::BeginDisabled(!refusal.empty());
  const bool entered = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false) && refusal.empty();
  const bool done = ImGui::Button(verb) || entered;
  ImGui::EndDisabled();
  ImGui::SameLine();
  if (ImGui::Button("cancel") || done) open_ = false;
  return done;
}

}  // namespace splatray
