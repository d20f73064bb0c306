#include "app/view/ui/field_controls.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>

#include "app/view/model/document_request.h"
#include "app/view/ui/panel_parts.h"
#include "engine/base/error.h"

namespace splatray {
namespace {

bool set(Request& request, const std::vector<FieldText>& values, std::string& error) {
  try {
    Request changed = request;
    assign(changed, values, DOORS_OF_PICTURES);
    request = std::move(changed);
    return true;
  } catch (const Error& refusal) {
    error = refusal.what();
    return false;
  }
}

/// A text that is taken over when it is complete.
bool text_control(const char* label, const Field& field, std::string& text) {
  return ImGui::InputTextWithHint(label, field.value.c_str(), &text, ImGuiInputTextFlags_EnterReturnsTrue);
}

bool single_control(const Field& field, Request& request, std::string& error) {
  const std::vector<std::string> texts = texts_of(field, request);
  std::string text = texts.empty() ? "" : texts.front();
  bool changed = false;
  if (field.kind == FieldKind::flag) {
    bool on = text == "on";
    changed = ImGui::Checkbox(field.name.c_str(), &on);
    text = on ? "on" : "off";
  } else if (!field.choices.empty()) {
    if (ImGui::BeginCombo(field.name.c_str(), text.c_str())) {
      for (const std::string& name : field.choices)
        if (ImGui::Selectable(name.c_str(), name == text)) changed = name != std::exchange(text, name);
      ImGui::EndCombo();
    }
  } else {
    changed = text_control(field.name.c_str(), field, text);
  }
  tip(field.help.c_str());
  return changed && set(request, {{field.name, text}}, error);
}

/// The values of the whole family are read again, with one of this field's replaced, added or, where its text is empty, left out.
bool repeated_control(const Field& field, Request& request, std::string& error) {
  std::vector<FieldText> values = family_values(field, request);
  std::erase(values, FieldText{"lights", "none"});
  values.push_back({field.name, ""});
  bool changed = false;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i].name != field.name) continue;
    ImGui::PushID(static_cast<int>(i));
    changed |= text_control(field.name.c_str(), field, values[i].text);
    tip(field.help.c_str());
    ImGui::PopID();
  }
  if (!changed) return false;
  std::erase_if(values, [](const FieldText& value) { return value.text.empty(); });
  if (values.empty() && field.family_name() == "lights") values.push_back({"lights", "none"});
  Request cleared = request;
  field.clear(cleared);
  if (!values.empty() && !set(cleared, values, error)) return false;
  request = std::move(cleared);
  return true;
}

}  // namespace

bool field_control(const Field& field, Request& request, std::string& error) {
  return field.repeated ? repeated_control(field, request, error) : single_control(field, request, error);
}

void all_fields(const Document& document, PanelState& state, Requests& requests) {
  Request request = request_of(document, 1, 1);
  bool changed = false;
  for (int group = 0; group <= static_cast<int>(FieldGroup::research); ++group) {
    const auto is_shown = [group](const Field& field) {
      return static_cast<int>(field.group) == group && field.in(DOOR_VIEW) && !field.is(OF_FILES);
    };
    if (std::none_of(fields().begin(), fields().end(), is_shown)) continue;
    if (!ImGui::TreeNode(group_title(static_cast<FieldGroup>(group)))) continue;
    for (const Field& field : fields())
      if (is_shown(field)) changed |= field_control(field, request, state.error);
    ImGui::TreePop();
  }
  if (changed) requests.change = request;
}

}  // namespace splatray
