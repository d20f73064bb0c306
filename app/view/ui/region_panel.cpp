#include <imgui.h>

#include <algorithm>
#include <array>

#include "app/view/model/navigation.h"
#include "app/view/ui/panel_parts.h"

namespace splatray {
namespace {

/// A box: switched on about all there is, turned, switched off.
void box_controls(const char* label, std::optional<TurnedBox>& box, const TurnedBox& first,
                  const char* words) {
  ImGui::PushID(label);
  bool on = box.has_value();
  if (ImGui::Checkbox(label, &on)) box = on ? std::optional(first) : std::nullopt;
  tip(words);
  if (box) {
    const double least = -180.0, most = 180.0;
    ImGui::SliderScalar("turn", ImGuiDataType_Double, &box->turn_deg, &least, &most, "%.1f\u00B0",
                        ImGuiSliderFlags_AlwaysClamp);
  }
  ImGui::PopID();
}

/// A box in the middle of what there is, half as large.
TurnedBox middle_box(const Document& document) {
  const TurnedBox all = box_of_all(document);
  const glm::dvec3 middle = 0.5 * (all.low + all.high), quarter = 0.25 * (all.high - all.low);
  return {middle - quarter, middle + quarter};
}

void slice_controls(Document& document) {
  RegionRequest& region = document.request.view.region;
  std::optional<Slice> slice = slice_of(region);
  struct Across {
    const char* label;
    int axis;
  };
  ImGui::TextUnformatted("section");
  for (const Across& across : {Across{"level", 1}, Across{"along", 2}, Across{"across", 0}}) {
    ImGui::SameLine();
    if (ImGui::SmallButton(across.label)) set_slice(region, first_slice(document, across.axis));
  }
  if (!slice) return;
  ImGui::SameLine();
  if (ImGui::SmallButton("none")) return remove_slice(region);
  const double radius = scene_radius_world(document);
  const glm::dvec3 middle = 0.5 * (document.bounds_min_world + document.bounds_max_world);
  double place = glm::dot(slice->point - middle, slice->normal);
  const double nearest = -radius, farthest = radius, thinnest = 1e-4 * radius, thickest = 2.0 * radius;
  bool changed = ImGui::SliderScalar("place", ImGuiDataType_Double, &place, &nearest, &farthest, "%.4g",
                                     ImGuiSliderFlags_AlwaysClamp);
  tip("from the middle of what there is, world units; Ctrl and the wheel move it");
  changed |= ImGui::SliderScalar("thickness", ImGuiDataType_Double, &slice->thickness, &thinnest, &thickest,
                                 "%.4g", ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic);
  if (!changed) return;
  slice->point += (place - glm::dot(slice->point - middle, slice->normal)) * slice->normal;
  set_slice(region, *slice);
}

/// A plane for each cut, and one more across the view.
void cut_controls(Document& document) {
  RegionRequest& region = document.request.view.region;
  std::vector<HalfSpace>& cuts = region.cuts;
  const std::size_t boxed = region.keep_box ? REGION_BOX_PLANES : 0;
  ImGui::BeginDisabled(cuts.size() + boxed >= REGION_PLANES_MOST);
  if (ImGui::SmallButton("plane across the view"))
    cuts.insert(cuts.begin(), {0.5 * (document.bounds_min_world + document.bounds_max_world),
                               glm::normalize(document.camera.target - document.camera.eye)});
  tip("what lies before it, as seen now, is cut away");
  ImGui::EndDisabled();
  std::size_t planes = cuts.size() - (slice_of(region) ? 2 : 0);
  for (std::size_t i = 0; i < planes; ++i) {
    ImGui::PushID(static_cast<int>(i));
    ImGui::Text("plane %zu", i + 1);
    ImGui::SameLine();
    if (ImGui::SmallButton("flip")) cuts[i].normal = -cuts[i].normal;
    ImGui::SameLine();
    const bool gone = ImGui::SmallButton("remove");
    ImGui::PopID();
    if (!gone) continue;
    cuts.erase(cuts.begin() + static_cast<std::ptrdiff_t>(i));
    return;
  }
}

}  // namespace

void region_panel(Document& document, PanelState& state) {
  RegionRequest& region = document.request.view.region;
  ImGui::Checkbox("look in", &document.request.view.look_in);
  tip("leave out what faces away from the eye, such as walls and ceilings before a room");
  box_controls("keep a box", region.keep_box, box_of_all(document),
               "only what is in it is shown; drag its faces in the picture");
  box_controls("drop a box", region.drop_box, middle_box(document), "all but what is in it is shown");
  slice_controls(document);
  cut_controls(document);
  bool kept_alone = region.light_kept.value_or(false);
  if (ImGui::Checkbox("light of what is kept alone", &kept_alone)) region.light_kept = kept_alone;
  tip("else what is cut away still shades and lights what is shown");
  ImGui::Checkbox("handles", &state.shows_handles);
  ImGui::SameLine();
  if (ImGui::SmallButton("show all of it")) region = {};
}

}  // namespace splatray
