#include <imgui.h>
#include <imgui_stdlib.h>

#include <array>
#include <cmath>

#include "app/view/ui/panel_parts.h"

namespace splatray {
namespace {

constexpr std::uint32_t LEAST_SAMPLES = 1, MOST_SAMPLES = 4096, LEAST_BOUNCES = 0, MOST_BOUNCES = 64;
constexpr double LEAST_EXPOSURE_EV = -10.0, MOST_EXPOSURE_EV = 10.0;

constexpr std::array BLENDS = {"window", "paper", "nearest", "leaf"};  // BLEND_*
constexpr std::array KERNELS = {"rim", "gaussian"};                    // KERNEL_*
constexpr std::array LOOKS = {"paper", "lit", "clay", "ao", "scan"};   // LOOK_*
constexpr std::array ENVIRONMENTS = {"studio", "white", "black"};

template <std::size_t N>
void choice(const char* label, std::uint32_t& value, const std::array<const char*, N>& names) {
  int index = static_cast<int>(value);
  if (ImGui::Combo(label, &index, names.data(), static_cast<int>(N)))
    value = static_cast<std::uint32_t>(index);
}

/// The text of --environment, taken over when it is complete.
void environment_text(std::string& environment) {
  std::string text = environment;
  if (ImGui::InputTextWithHint("map", "file, name or r,g,b", &text, ImGuiInputTextFlags_EnterReturnsTrue))
    environment = text;
  tip("an HDR or EXR file, studio, white, black, or a radiance r,g,b; Enter takes it. Or drop a file.");
}

}  // namespace

void environment_panel(Document& document) {
  environment_text(document.environment);
  for (const char* name : ENVIRONMENTS) {
    if (ImGui::SmallButton(name)) document.environment = name;
    ImGui::SameLine();
  }
  ImGui::NewLine();
  ImGui::DragFloat("strength", &document.settings.environment_strength, 0.01F, 0.0F, 1e6F, "%.3g",
                   ImGuiSliderFlags_AlwaysClamp);
  float degrees = 360.0F * document.settings.environment_turn;
  if (ImGui::SliderFloat("turn", &degrees, 0.0F, 360.0F, "%.0f\u00B0", ImGuiSliderFlags_AlwaysClamp))
    document.settings.environment_turn = degrees / 360.0F;
}

void quality_panel(Document& document) {
  Settings& settings = document.settings;
  choice("look", settings.look, LOOKS);
  tip("paper: Phong, hard shadows, mirrors and glass; lit: path tracing; clay: the same, white; ao: ambient "
      "occlusion; scan: colours under "
      "occlusion and a soft light");
  ImGui::SliderScalar("samples", ImGuiDataType_U32, &settings.samples, &LEAST_SAMPLES, &MOST_SAMPLES, "%u",
                      ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic);
  tip("per pixel, where a still picture stops");
  ImGui::SliderScalar("bounces", ImGuiDataType_U32, &settings.max_bounces, &LEAST_BOUNCES, &MOST_BOUNCES,
                      "%u", ImGuiSliderFlags_AlwaysClamp);
  ImGui::Checkbox("shadows", &settings.shadows);
  ImGui::SliderScalar("exposure", ImGuiDataType_Double, &document.exposure_ev, &LEAST_EXPOSURE_EV,
                      &MOST_EXPOSURE_EV, "%+.2f EV", ImGuiSliderFlags_AlwaysClamp);
  auto tone = static_cast<std::uint32_t>(document.tone);
  choice("tone", tone, TONE_NAMES);
  document.tone = static_cast<Tone>(tone);
  choice("blend", settings.blend, BLENDS);
  tip("how overlapping splats make one surface");
  choice("kernel", settings.kernel, KERNELS);
  ImGui::SliderFloat("kappa", &settings.kappa, 0.05F, 4.0F, "%.2f", ImGuiSliderFlags_AlwaysClamp);
  tip("depth of the blending window, in radii of the first splat");
}

}  // namespace splatray
