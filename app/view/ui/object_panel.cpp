#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>

#include "app/library/materials.h"
#include "app/library/shot/scene_source.h"
#include "app/view/ui/panel_parts.h"
#include "engine/scene/look_style.h"
#include "engine/scene/material_fields.h"
#include "engine/scene/phong.h"

namespace splatray {
namespace {

constexpr float OBJECT_LIST_EM = 8.0F;  ///< height of the list of objects
constexpr float MOST_SHININESS = 1e4F, LEAST_IOR = 0.2F, MOST_IOR = 4.0F, GLASS_IOR = 1.52F;

bool has(const Material& material, std::uint32_t flag) { return (material.flags & flag) != 0; }

void set(Material& material, std::uint32_t flag, bool on) {
  material.flags = on ? material.flags | flag : material.flags & ~flag;
}

std::string shown_name(const Document& document, std::size_t object) {
  const std::string& name = document.loaded->object_names[object];
  return name.empty() ? "object " + std::to_string(object) : name;
}

std::vector<std::size_t> filtered_objects(const Document& document, const std::string& filter) {
  std::vector<std::size_t> objects;
  for (std::size_t i = 0; i < document.materials.size(); ++i)
    if (filter.empty() || shown_name(document, i).find(filter) != std::string::npos) objects.push_back(i);
  return objects;
}

void object_row(Document& document, PanelState& state, std::size_t object) {
  ImGui::PushID(static_cast<int>(object));
  Material& material = document.materials[object];
  bool visible = !has(material, MATERIAL_HIDDEN);
  if (ImGui::Checkbox("##visible", &visible)) set(material, MATERIAL_HIDDEN, !visible);
  tip("shown or hidden");
  ImGui::SameLine();
  if (ImGui::Selectable(shown_name(document, object).c_str(), state.object == object))
    state.object = static_cast<std::uint32_t>(object);
  ImGui::PopID();
}

/// Buttons that show and hide all objects listed.
void visibility_buttons(Document& document, const std::vector<std::size_t>& objects) {
  const bool all = ImGui::SmallButton("show all");
  ImGui::SameLine();
  const bool none = ImGui::SmallButton("hide all");
  ImGui::SameLine();
  const bool invert = ImGui::SmallButton("invert");
  if (!all && !none && !invert) return;
  for (const std::size_t object : objects) {
    Material& material = document.materials[object];
    set(material, MATERIAL_HIDDEN, none || (invert && !has(material, MATERIAL_HIDDEN)));
  }
}

/// Replaces a material by that of a name.
void preset_combo(Material& material) {
  if (!ImGui::BeginCombo("preset", "choose")) return;
  for (const std::string& name : material_names())
    if (ImGui::Selectable(name.c_str())) change_material(material, name);
  ImGui::EndCombo();
}

/// Glass is one-sided: the side that is hit distinguishes inside from outside.
void glass_switch(Material& material) {
  bool glass = has(material, MATERIAL_DIELECTRIC);
  if (!ImGui::Checkbox("glass", &glass)) return;
  set(material, MATERIAL_DIELECTRIC, glass);
  set(material, MATERIAL_TWO_SIDED, !glass);
  if (glass && material.ior == 1.0F) material.ior = GLASS_IOR;
  if (glass && material.phong.tint == vec3(0.0F)) material.phong.tint = vec3(1.0F);
}

void share(const char* label, float& value) {
  ImGui::SliderFloat(label, &value, 0.0F, 1.0F, "%.3f", ImGuiSliderFlags_AlwaysClamp);
}

void phong_controls(Material& material) {
  color_edit("diffuse", material.phong.diffuse);
  share("specular", material.phong.specular);
  ImGui::SliderFloat("shininess", &material.phong.shininess, 1.0F, MOST_SHININESS, "%.0f",
                     ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic);
  share("mirror", material.phong.mirror);
  tip("share of the light that is mirrored; the rest is shaded");
  bool two_sided = has(material, MATERIAL_TWO_SIDED);
  if (ImGui::Checkbox("two-sided", &two_sided)) set(material, MATERIAL_TWO_SIDED, two_sided);
}

/// A colour that may be brighter than white: strength and hue.
void radiance_edit(const char* label, vec3& radiance, float most) {
  float strength = std::max({radiance.x, radiance.y, radiance.z});
  vec3 color = strength > 0.0F ? radiance / strength : vec3(1.0F);
  bool changed = ImGui::DragFloat(label, &strength, 0.02F, 0.0F, most, "%.3g", ImGuiSliderFlags_AlwaysClamp);
  if (strength > 0.0F) changed |= color_edit("its colour", color);
  if (changed) radiance = strength * color;
}

/// Controls the numbers of a material that path tracing alone sees.
void light_controls(Material& material) {
  for (const MaterialField& field : material_fields()) {
    if (field.key == nullptr) continue;
    std::string label = field.key;
    std::replace(label.begin(), label.end(), '-', ' ');
    if (field.number != nullptr)
      ImGui::SliderFloat(label.c_str(), &(material.*field.number), field.least, field.most, "%.3f",
                         ImGuiSliderFlags_AlwaysClamp);
    else
      radiance_edit(label.c_str(), material.*field.color, field.most);
  }
}

void material_controls(Material& material) {
  glass_switch(material);
  const bool glass = has(material, MATERIAL_DIELECTRIC);
  if (glass)
    ImGui::SliderFloat("ior", &material.ior, LEAST_IOR, MOST_IOR, "%.3f", ImGuiSliderFlags_AlwaysClamp);
  else
    phong_controls(material);
  color_edit("tint", material.phong.tint);
  tip(glass ? "transmittance of each crossing" : "reflectance of the mirror");
}

/// Says where a look shows no materials, and offers one that does.
void look_note(Document& document) {
  if (look_style(look_of(document)).materials) return;
  ImGui::TextWrapped("This look shows no materials.");
  if (ImGui::SmallButton("look lit")) document.request.look.style = LOOK_LIT;
}

}  // namespace

void object_panel(Document& document, PanelState& state) {
  const float em = ImGui::GetFontSize();
  if (document.materials.size() > 1) {
    ImGui::SetNextItemWidth(-em);
    ImGui::InputTextWithHint("##filter", "part of a name", &state.object_filter);
  }
  const std::vector<std::size_t> objects = filtered_objects(document, state.object_filter);
  visibility_buttons(document, objects);
  const float rows = static_cast<float>(objects.size()) * ImGui::GetFrameHeightWithSpacing();
  ImGui::BeginChild("objects", {0.0F, std::min(rows + em, OBJECT_LIST_EM * em)}, true);
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(objects.size()));
  while (clipper.Step())
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i)
      object_row(document, state, objects[static_cast<std::size_t>(i)]);
  ImGui::EndChild();
}

void material_panel(Document& document, PanelState& state) {
  if (document.materials.empty()) return;
  state.object = std::min(state.object, static_cast<std::uint32_t>(document.materials.size() - 1));
  ImGui::PushID(static_cast<int>(state.object));
  ImGui::TextUnformatted(shown_name(document, state.object).c_str());
  Material& material = document.materials[state.object];
  preset_combo(material);
  const Material before = material;
  material_controls(material);
  follow_change(before, material);
  look_note(document);
  if (look_of(document) == LOOK_LIT) light_controls(material);
  if (ImGui::Button("as loaded")) material = document.loaded->materials[state.object];
  ImGui::PopID();
}

}  // namespace splatray
