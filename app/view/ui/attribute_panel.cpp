#include <imgui.h>

#include <algorithm>

#include "app/view/ui/panel_parts.h"
#include "engine/base/srgb.h"
#include "engine/scene/splat.h"

namespace splatray {
namespace {

constexpr float CLASS_LIST_EM = 8.0F;  ///< height of the list of classes, or of scans

void source_combo(Document& document) {
  const std::vector<std::string>& sources = document.loaded->color_sources;
  AttributeOptions& attributes = document.request.look.attributes;
  std::string& shown = attributes.color_by;
  if (!ImGui::BeginCombo("colours", shown.empty() ? sources.front().c_str() : shown.c_str())) return;
  for (const std::string& source : sources) {
    if (!ImGui::Selectable(source.c_str(), source == (shown.empty() ? sources.front() : shown))) continue;
    shown = source;
    attributes.color_range.reset();
  }
  ImGui::EndCombo();
}

/// The ends of a ramp's values; what is not edited stays at its percentiles.
void range_edit(Document& document, const PanelView& view) {
  if (view.frame == nullptr || view.frame->legend.ramp.empty()) return;
  const ColorLegend& legend = view.frame->legend;
  std::optional<std::array<double, 2>>& shown = document.request.look.attributes.color_range;
  std::array<double, 2> range = shown.value_or(std::array{legend.low, legend.high});
  const float speed = static_cast<float>(std::max(legend.high - legend.low, 1e-6) / 200.0);
  const bool low =
      ImGui::DragScalar("low", ImGuiDataType_Double, range.data(), speed, nullptr, nullptr, "%.6g");
  const bool high =
      ImGui::DragScalar("high", ImGuiDataType_Double, &range[1], speed, nullptr, nullptr, "%.6g");
  if ((low || high) && range[0] < range[1]) shown = range;
  if (shown && ImGui::SmallButton("automatic range")) shown.reset();
}

/// Switches for what is hidden.
void category_list(const char* title, const std::vector<Category>& categories,
                   std::vector<std::uint32_t>& hidden) {
  if (categories.size() < 2) return;
  ImGui::TextDisabled("%s", title);
  const float rows = static_cast<float>(categories.size()) * ImGui::GetFrameHeightWithSpacing();
  ImGui::BeginChild(title, {0.0F, std::min(rows, CLASS_LIST_EM * ImGui::GetFontSize())});
  for (const Category& category : categories) {
    const auto found = std::find(hidden.begin(), hidden.end(), category.value);
    bool visible = found == hidden.end();
    const std::string number = std::to_string(category.value);
    const std::string label = (category.name.empty() ? number : number + "  " + category.name) + "  (" +
                              std::to_string(category.points) + ")";
    ImGui::PushID(static_cast<int>(category.value));
    category_swatch(category);
    if (ImGui::Checkbox(label.c_str(), &visible)) {
      if (visible)
        hidden.erase(found);
      else
        hidden.insert(std::lower_bound(hidden.begin(), hidden.end(), category.value), category.value);
    }
    ImGui::PopID();
  }
  ImGui::EndChild();
}

}  // namespace

void category_swatch(const Category& category) {
  const glm::vec3 encoded = linear_to_srgb(unpack_color(category.color));
  const ImVec4 color(encoded.x, encoded.y, encoded.z, 1.0F);
  const float em = ImGui::GetFontSize();
  ImGui::ColorButton("##color", color, ImGuiColorEditFlags_NoTooltip, {em, em});
  ImGui::SameLine();
}

void drawing_controls(Document& document) {
  const double none = 0.0, most = 4.0, smallest = 0.25;
  ImGui::SliderScalar("depth shade", ImGuiDataType_Double, &document.eye_dome, &none, &most, "%.2f",
                      ImGuiSliderFlags_AlwaysClamp);
  tip("how much darker what lies behind is, while the picture moves and while points are loaded");
  ImGui::SliderScalar("point size", ImGuiDataType_Double, &document.point_size, &smallest, &most, "%.2f",
                      ImGuiSliderFlags_AlwaysClamp);
  tip("of points while they are loaded, in distances between them");
}

void attribute_panel(Document& document, const PanelView& view) {
  source_combo(document);
  range_edit(document, view);
  AttributeOptions& attributes = document.request.look.attributes;
  category_list("classes", document.loaded->classes, attributes.hidden_classes);
  category_list("scans", document.loaded->scans, attributes.hidden_scans);
}

}  // namespace splatray
