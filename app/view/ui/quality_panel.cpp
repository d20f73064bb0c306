#include <imgui.h>
#include <imgui_stdlib.h>

#include <array>

#include "app/library/shot/resolve.h"
#include "app/view/model/document_request.h"
#include "app/view/ui/field_controls.h"
#include "app/view/ui/panel_parts.h"

namespace splatray {
namespace {

constexpr std::uint32_t LEAST_SAMPLES = 1, MOST_SAMPLES = 4096, LEAST_BOUNCES = 0, MOST_BOUNCES = 64;
constexpr double LEAST_EXPOSURE_EV = -20.0, MOST_EXPOSURE_EV = 20.0;

constexpr std::array ENVIRONMENTS = {"studio", "white", "black", "sky:40,135"};

/// The controls of some fields; what is left open by one, the scene or the look decides at once.
void choices(Document& document, std::initializer_list<const char*> names, std::string& error) {
  Request& request = document.request;
  bool changed = false;
  for (const char* name : names) changed |= field_control(*find_field(name, DOOR_VIEW), request, error);
  if (!changed) return;
  request.look.style = look_of(document);
  request.look.tone = resolve_tone(request);
}

/// The text of --environment, taken over when it is complete.
void environment_text(std::string& environment) {
  std::string text = environment;
  if (ImGui::InputTextWithHint("map", "file, name or r,g,b", &text, ImGuiInputTextFlags_EnterReturnsTrue))
    environment = text;
  tip("an HDR or EXR file, studio, white, black, or a radiance r,g,b; Enter takes it. Or drop a file.");
}

/// One colour behind everything, instead of the surroundings.
void background_controls(Request::Settings& settings) {
  bool plain = settings.background.has_value();
  if (ImGui::Checkbox("plain background", &plain)) {
    settings.background = plain ? std::optional(glm::vec3(1.0F)) : std::nullopt;
    settings.asked_environment_seen = !plain;
  }
  if (settings.background) color_edit("background", *settings.background);
}

}  // namespace

void environment_panel(Document& document) {
  std::string environment = document.request.look.environment;
  environment_text(environment);
  for (const char* name : ENVIRONMENTS) {
    if (ImGui::SmallButton(name)) environment = name;
    ImGui::SameLine();
  }
  if (environment != document.request.look.environment) show_environment(environment, document);
  ImGui::NewLine();
  Request::Settings& settings = document.request.settings;
  ImGui::DragFloat("strength", &settings.environment_strength, 0.01F, 0.0F, 1e6F, "%.3g",
                   ImGuiSliderFlags_AlwaysClamp);
  float degrees = 360.0F * settings.environment_turn;
  background_controls(settings);
  if (ImGui::SliderFloat("turn", &degrees, 0.0F, 360.0F, "%.0f\u00B0", ImGuiSliderFlags_AlwaysClamp))
    settings.environment_turn = degrees / 360.0F;
}

void quality_panel(Document& document, PanelState& state) {
  Settings& settings = document.request.settings;
  choices(document, {"look"}, state.error);
  ImGui::SliderScalar("samples", ImGuiDataType_U32, &settings.samples, &LEAST_SAMPLES, &MOST_SAMPLES, "%u",
                      ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic);
  tip("per pixel, where a still picture stops");
  ImGui::SliderScalar("bounces", ImGuiDataType_U32, &settings.max_bounces, &LEAST_BOUNCES, &MOST_BOUNCES,
                      "%u", ImGuiSliderFlags_AlwaysClamp);
  ImGui::Checkbox("shadows", &settings.shadows);
  double exposure_ev = exposure_of(document);
  if (ImGui::SliderScalar("exposure", ImGuiDataType_Double, &exposure_ev, &LEAST_EXPOSURE_EV,
                          &MOST_EXPOSURE_EV, "%+.2f EV", ImGuiSliderFlags_AlwaysClamp))
    document.request.look.exposure_ev = exposure_ev;
  choices(document, {"tone", "blend", "kernel"}, state.error);
  ImGui::SliderFloat("kappa", &settings.kappa, 0.05F, 4.0F, "%.2f", ImGuiSliderFlags_AlwaysClamp);
  tip("depth of the blending window, in radii of the first splat");
}

}  // namespace splatray
