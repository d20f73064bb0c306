#include <imgui.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "app/library/palette.h"
#include "app/view/ui/panel_parts.h"
#include "engine/base/srgb.h"
#include "engine/scene/splat.h"

namespace splatray {
namespace {

constexpr float MARGIN_EM = 0.7F;
constexpr float BAR_EM = 22.0F;        ///< width of the progress bar
constexpr float SCALE_EM = 14.0F;      ///< width of a colour scale
constexpr int SCALE_STEPS = 48;        ///< of the colours in it
constexpr float HELP_KEYS_EM = 13.5F;  ///< width of the column of keys
constexpr float HELP_EM = 48.0F;
constexpr std::size_t MOST_LEGEND_ROWS = 24;

constexpr ImGuiWindowFlags OVERLAY = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                                     ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                                     ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;

/// A window without a frame at a share of the picture's area, its own same share there.
bool begin_overlay(const char* name, float width_px, ImVec2 share, ImGuiWindowFlags more_flags) {
  const float margin = MARGIN_EM * ImGui::GetFontSize(), height_px = ImGui::GetIO().DisplaySize.y;
  const ImVec2 place{margin + share.x * (width_px - 2.0F * margin),
                     margin + share.y * (height_px - 2.0F * margin)};
  ImGui::SetNextWindowPos(place, ImGuiCond_Always, share);
  ImGui::SetNextWindowBgAlpha(0.75F);
  return ImGui::Begin(name, nullptr, OVERLAY | more_flags);
}

/// How far the picture has come; other modes than shaded have one ray in each pixel.
std::string samples_text(const Document& document, const Frame& frame) {
  if (document.mode != ViewMode::shaded) return "";
  return "  \u00B7  " + std::to_string(frame.samples) + " of " +
         std::to_string(document.request.settings.samples) + " samples" +
         (frame.denoised ? ", without noise" : "");
}

std::string status_text(const Document& document, const Frame& frame, double frames_per_second) {
  std::array<char, 200> text{};
  if (frame.of_points) return "points of the file, until the scene is made";
  std::snprintf(text.data(), text.size(),
                "%s%s  \u00B7  %u x %u, scale %.2f  \u00B7  %.0f ms  \u00B7  %.1f a second",
                view_mode_name(document.mode), samples_text(document, frame).c_str(), frame.image.width,
                frame.image.height, frame.scale, frame.ms, frames_per_second);
  return text.data();
}

/// `color` gives the colour of a share 0..1, display-encoded.
template <typename Color>
void color_scale(const ColorRange& range, const char* meaning, const Color& color_of) {
  const float em = ImGui::GetFontSize(), step = SCALE_EM * em / SCALE_STEPS;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  for (int i = 0; i < SCALE_STEPS; ++i) {
    const glm::vec3 color = color_of((static_cast<float>(i) + 0.5F) / SCALE_STEPS);
    const ImVec2 from{corner.x + static_cast<float>(i) * step, corner.y};
    ImGui::GetWindowDrawList()->AddRectFilled(from, {from.x + step + 1.0F, corner.y + em},
                                              ImGui::GetColorU32(ImVec4(color.r, color.g, color.b, 1.0F)));
  }
  ImGui::Dummy({SCALE_EM * em, em});
  std::array<char, 40> high{};
  std::snprintf(high.data(), high.size(), "%.4g", range.high);
  ImGui::Text("%.4g", range.low);
  ImGui::SameLine(SCALE_EM * em - ImGui::CalcTextSize(high.data()).x + ImGui::GetStyle().WindowPadding.x);
  ImGui::TextUnformatted(high.data());
  ImGui::TextUnformatted(meaning);
}

/// What the points' colours mean.
void attribute_legend(const ColorLegend& legend) {
  if (!legend.ramp.empty()) {
    color_scale({legend.low, legend.high}, legend.title.c_str(), [&legend](float share) {
      const float last = static_cast<float>(legend.ramp.size() - 1);
      return linear_to_srgb(unpack_color(legend.ramp[static_cast<std::size_t>(share * last)]));
    });
    return;
  }
  ImGui::TextUnformatted(legend.title.c_str());
  for (std::size_t i = 0; i < std::min(legend.categories.size(), MOST_LEGEND_ROWS); ++i) {
    const Category& category = legend.categories[i];
    ImGui::PushID(static_cast<int>(category.value));
    category_swatch(category);
    ImGui::Text("%u  %s", category.value, category.name.c_str());
    ImGui::PopID();
  }
  if (legend.categories.size() > MOST_LEGEND_ROWS)
    ImGui::Text("and %zu more", legend.categories.size() - MOST_LEGEND_ROWS);
}

/// Ends a notice after its time, which runs while nothing is under way.
void age_notice(PanelState& state, const PanelView& view) {
  const double now = ImGui::GetTime();
  if (view.work != nullptr || state.notice != state.notice_shown) {
    state.notice_shown = state.notice;
    state.notice_end = now + NOTICE_SECONDS;
  }
  if (now > state.notice_end) state.notice.clear();
}

}  // namespace

void status_line(const Document& document, PanelState& state, const PanelView& view, float width_px) {
  age_notice(state, view);
  const bool facts = view.frame != nullptr && state.show_panels;
  if (!facts && state.notice.empty()) return;
  begin_overlay("##status", width_px, {0.0F, 1.0F}, ImGuiWindowFlags_NoInputs);
  ImGui::PushTextWrapPos(width_px - 2.0F * MARGIN_EM * ImGui::GetFontSize());
  if (!state.notice.empty()) ImGui::TextUnformatted(state.notice.c_str());
  ImGui::PopTextWrapPos();
  if (facts) ImGui::TextUnformatted(status_text(document, *view.frame, view.frames_per_second).c_str());
  ImGui::End();
}

void work_bar(const PanelView& view, float width_px, Requests& requests) {
  if (view.work == nullptr) return;
  begin_overlay("##work", width_px, {0.5F, 0.0F}, 0);
  const float em = ImGui::GetFontSize();
  ImGui::ProgressBar(static_cast<float>(view.work->share), {BAR_EM * em, 0.0F}, view.work->stage.c_str());
  ImGui::SameLine();
  if (ImGui::Button("cancel")) requests.cancel = true;
  ImGui::End();
}

void legend(const PanelView& view, float width_px) {
  if (view.frame == nullptr) return;
  const Frame& frame = *view.frame;
  if (frame.mode == ViewMode::shaded && frame.legend.title.empty()) return;
  begin_overlay("##legend", width_px, {0.0F, 0.0F}, ImGuiWindowFlags_NoInputs);
  if (frame.mode == ViewMode::shaded)
    attribute_legend(frame.legend);
  else if (has_scale(frame.mode))
    color_scale(frame.range, view_mode_legend(frame.mode), heat_color);
  else
    ImGui::TextUnformatted(view_mode_legend(frame.mode));
  ImGui::End();
}

void help_overlay(PanelState& state) {
  if (!state.show_help) return;
  const float em = ImGui::GetFontSize();
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const ImVec2 size{std::min(HELP_EM * em, display.x - em), 0.0F};
  ImGui::SetNextWindowPos({0.5F * display.x, 0.5F * display.y}, ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowSizeConstraints({size.x, 0.0F}, {size.x, display.y - em});
  constexpr ImGuiWindowFlags FLAGS =
      ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize;
  if (ImGui::Begin("Keys and mouse", &state.show_help, FLAGS) && ImGui::BeginTable("keys", 2)) {
    ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthFixed, HELP_KEYS_EM * em);
    ImGui::TableSetupColumn("does", ImGuiTableColumnFlags_WidthStretch);
    for (const KeyRow& row : key_rows()) {
      ImGui::TableNextColumn();
      ImGui::TextWrapped("%s", row.keys.c_str());
      ImGui::TableNextColumn();
      ImGui::TextWrapped("%s", row.does.c_str());
    }
    ImGui::EndTable();
  }
  ImGui::End();
}

void welcome(const PanelState& state, float width_px, Requests& requests) {
  begin_overlay("##welcome", width_px, {0.5F, 0.4F}, 0);
  ImGui::TextUnformatted("Drop a point cloud, mesh or scene here.");
  command_button("open a file", Action::open, requests);
  ImGui::SameLine();
  command_button("keys", Action::help, requests);
  if (!state.recent_files.empty()) ImGui::Separator();
  recent_list(state, requests);
  ImGui::End();
}

}  // namespace splatray
