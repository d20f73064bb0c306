#include <imgui.h>

#include "app/view/ui/panel_parts.h"

namespace splatray {
namespace {

void kind_buttons(PanelState& state) {
  for (int i = 0; i < MEASURE_KINDS; ++i) {
    const auto kind = static_cast<MeasureKind>(i);
    if (i % 4 != 0) ImGui::SameLine();
    const bool on = state.measuring == kind;
    if (on) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
    if (ImGui::Button(measure_name(kind))) state.measuring = on ? std::nullopt : std::optional(kind);
    if (on) ImGui::PopStyleColor();
  }
  tip("click points in the picture, of a sphere or cylinder its middle; Backspace takes the last one back, "
      "Esc ends");
}

/// Returns whether it is to be removed.
bool measure_facts(const Measure& measure, const glm::dvec3& up) {
  const std::vector<MeasureValue> values = values_of(measure, up);
  if (values.empty())
    ImGui::TextDisabled("%s: %zu of %zu points", measure_name(measure.kind), measure.points.size(),
                        points_needed(measure.kind));
  for (const MeasureValue& value : values) fact(value.name.c_str(), value_text(value));
  return ImGui::SmallButton("remove");
}

}  // namespace

void measure_panel(Document& document, PanelState& state) {
  kind_buttons(state);
  if (document.measures.empty()) return;
  if (ImGui::SmallButton("copy all")) {
    ImGui::SetClipboardText(table_of(document.measures, document.up).c_str());
    state.notice = "copied the measures: values and points, with tabs between";
  }
  ImGui::SameLine();
  if (ImGui::SmallButton("remove all")) return document.measures.clear();
  for (std::size_t i = 0; i < document.measures.size(); ++i) {
    ImGui::Separator();
    ImGui::PushID(static_cast<int>(i));
    const bool gone = measure_facts(document.measures[i], document.up);
    ImGui::PopID();
    if (!gone) continue;
    document.measures.erase(document.measures.begin() + static_cast<std::ptrdiff_t>(i));
    return;
  }
}

}  // namespace splatray
