#include <imgui.h>

#include <filesystem>

#include "app/view/ui/panels.h"

namespace splatray {
namespace {

/// At scale 1; the fallback is drawn for 13 pixels.
constexpr float FONT_PX = 15.0F, FALLBACK_FONT_PX = 13.0F;
/// Debian's fonts-dejavu-core; Dear ImGui's own font is used where it is not installed.
constexpr const char* FONT_FILE = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

const ImVec4 SHADE{0.0F, 0.0F, 0.0F, 0.45F}, INK{0.91F, 0.92F, 0.93F, 1.0F}, FAINT{0.60F, 0.63F, 0.66F, 1.0F},
    BACK{0.075F, 0.08F, 0.09F, 0.97F}, FIELD{0.16F, 0.17F, 0.19F, 1.0F},
    FIELD_OVER{0.22F, 0.24F, 0.27F, 1.0F}, ACCENT_DARK{0.12F, 0.23F, 0.30F, 1.0F},
    ACCENT{0.16F, 0.45F, 0.60F, 1.0F}, ACCENT_OVER{0.20F, 0.54F, 0.71F, 1.0F},
    BRIGHT{0.38F, 0.76F, 0.94F, 1.0F}, LINE{0.26F, 0.28F, 0.31F, 1.0F};

void load_font(double ui_scale) {
  const float scale = static_cast<float>(ui_scale);
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  fonts.Clear();
  std::error_code failed;
  if (std::filesystem::is_regular_file(FONT_FILE, failed) &&
      fonts.AddFontFromFileTTF(FONT_FILE, FONT_PX * scale) != nullptr)
    return;
  ImFontConfig config;
  config.SizePixels = FALLBACK_FONT_PX * scale;
  fonts.AddFontDefault(&config);
}

void set_colors(ImGuiStyle& style) {
  ImGui::StyleColorsDark(&style);
  const auto set = [&style](const ImVec4& color, std::initializer_list<ImGuiCol> places) {
    for (const ImGuiCol place : places) style.Colors[place] = color;
  };
  set(INK, {ImGuiCol_Text});
  set(SHADE, {ImGuiCol_ModalWindowDimBg});
  set(FAINT, {ImGuiCol_TextDisabled});
  set(BACK, {ImGuiCol_WindowBg, ImGuiCol_PopupBg, ImGuiCol_TitleBg, ImGuiCol_TitleBgActive});
  set(FIELD, {ImGuiCol_FrameBg, ImGuiCol_Button, ImGuiCol_ScrollbarGrab});
  set(ACCENT_DARK, {ImGuiCol_Header});
  set(FIELD_OVER, {ImGuiCol_FrameBgHovered, ImGuiCol_FrameBgActive, ImGuiCol_HeaderHovered,
                   ImGuiCol_ScrollbarGrabHovered});
  set(ACCENT,
      {ImGuiCol_HeaderActive, ImGuiCol_ButtonHovered, ImGuiCol_PlotHistogram, ImGuiCol_TextSelectedBg});
  set(ACCENT_OVER, {ImGuiCol_ButtonActive, ImGuiCol_SliderGrab, ImGuiCol_ScrollbarGrabActive});
  set(BRIGHT, {ImGuiCol_CheckMark, ImGuiCol_SliderGrabActive});
  set(LINE, {ImGuiCol_Border, ImGuiCol_Separator});
}

}  // namespace

void set_style(double ui_scale) {
  ImGuiStyle style;
  style.WindowRounding = style.PopupRounding = style.ChildRounding = 5.0F;
  style.FrameRounding = style.GrabRounding = 3.0F;
  style.WindowBorderSize = 0.0F;
  style.FramePadding = {7.0F, 3.0F};
  style.ItemSpacing = {7.0F, 5.0F};
  style.ScrollbarSize = 11.0F;
  set_colors(style);
  style.ScaleAllSizes(static_cast<float>(ui_scale));
  ImGui::GetStyle() = style;
  load_font(ui_scale);
}

float panel_column_px(const PanelState& state, float window_width_px) {
  constexpr float COLUMN_PX = 300.0F, MOST_SHARE = 0.5F;
  if (!state.show_panels) return 0.0F;
  return std::min(COLUMN_PX * static_cast<float>(state.ui_scale), MOST_SHARE * window_width_px);
}

}  // namespace splatray
