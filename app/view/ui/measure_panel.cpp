#include <imgui.h>
#include <imgui_stdlib.h>

#include "app/library/measure/measure_file.h"
#include "app/view/model/attempt.h"
#include "app/view/ui/panel_parts.h"
#include "engine/base/crs.h"

namespace splatray {
namespace {

void kind_buttons(PanelState& state) {
  for (int i = 0; i < MARKED_KINDS; ++i) {
    const auto kind = static_cast<MeasureKind>(i);
    if (i % 3 != 0) ImGui::SameLine();
    const bool on = state.measuring == kind;
    if (on) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
    if (ImGui::Button(measure_name(kind))) state.measuring = on ? std::nullopt : std::optional(kind);
    if (on) ImGui::PopStyleColor();
  }
  tip("click points in the picture; Backspace takes the last one back, Esc ends");
}

/// Writes all of them in the format of the name.
void save_control(const Document& document, PanelState& state) {
  ImGui::InputText("file##measures", &state.measures_path);
  tip(".geojson, .dxf or .csv");
  if (!ImGui::SmallButton("save all")) return;
  const auto write = [&] { write_measures(document.measures, measure_frame(document), state.measures_path); };
  if (const std::optional<Failure> failure = attempt("writing " + state.measures_path, write))
    state.error = failure->sentence;
  else
    state.notice = "Written: " + state.measures_path;
}

/// Returns whether it is to be removed.
bool measure_facts(const MeasureFrame& frame, Measure& measure) {
  const std::vector<MeasureValue> values = values_of(measure, frame.up);
  if (values.empty())
    ImGui::TextDisabled("%s: %zu of %zu points", measure_name(measure.kind), measure.points.size(),
                        points_needed(measure.kind));
  for (const MeasureValue& value : values) fact(value.name.c_str(), value_text(value, unit_metres(frame)));
  ImGui::InputText("name", &measure.name);
  return ImGui::SmallButton("remove");
}

}  // namespace

void measure_panel(Document& document, PanelState& state) {
  kind_buttons(state);
  if (document.measures.empty()) return;
  if (const std::string different = different_units(describe_crs(measure_frame(document).crs));
      !different.empty())
    ImGui::TextWrapped("%s: distances are right only with --z-scale", different.c_str());
  if (ImGui::SmallButton("copy all")) {
    ImGui::SetClipboardText(table_of(document.measures, measure_frame(document)).c_str());
    state.notice = "copied the measures: values and points, with tabs between";
  }
  ImGui::SameLine();
  if (ImGui::SmallButton("remove all")) return document.measures.clear();
  save_control(document, state);
  for (std::size_t i = 0; i < document.measures.size(); ++i) {
    ImGui::Separator();
    ImGui::PushID(static_cast<int>(i));
    const bool gone = measure_facts(measure_frame(document), document.measures[i]);
    ImGui::PopID();
    if (!gone) continue;
    document.measures.erase(document.measures.begin() + static_cast<std::ptrdiff_t>(i));
    return;
  }
}

}  // namespace splatray
