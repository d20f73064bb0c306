/// The panels over the picture: what a person sees and changes. Dear ImGui between NewFrame and Render; no window.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "app/library/request/request.h"
#include "app/view/model/document.h"
#include "app/view/model/frame.h"
#include "app/view/model/keys.h"
#include "app/view/model/panel_state.h"
#include "app/view/model/region_edit.h"
#include "app/view/model/scene_files.h"

namespace splatray {

/// What a person asked for in the panels, beyond changes of the document.
struct Requests {
  std::vector<Command> commands;   ///< buttons that do what a key does
  std::optional<SceneFiles> open;  ///< a scene
  bool add = false;                ///< `open` goes beside what is shown
  std::optional<Request> save;     ///< a picture, several or a drawing: what saved_request() takes of it
  std::optional<Request> change;   ///< the document becomes what this asks for
  bool cancel = false;             ///< stop the work that PanelView::work shows
};

/// What the panels show beside the document.
struct PanelView {
  const Frame* frame = nullptr;             ///< newest; null before the first
  const Inspected* inspected = nullptr;     ///< null: nothing inspected
  double frames_per_second = 0.0;           ///< pictures handed to the window
  const Work* work = nullptr;               ///< loading, saving or recording; null when idle
  glm::uvec2 picture_px{0};                 ///< size of the picture, pixels of the framebuffer
  std::optional<glm::dvec3> about_world{};  ///< what the camera turns about just now
  std::uint64_t cache_bytes = 0;            ///< of scenes kept for the next opening
  const Grip* handle = nullptr;             ///< that is held; null = none
};

/// Font and colours for `ui_scale`; replaces the font atlas (its texture must be uploaded anew).
void set_style(double ui_scale);

/// Width of the column of panels on the right, window pixels; 0 when hidden. The picture is to the left of it.
[[nodiscard]] float panel_column_px(const PanelState& state, float window_width_px);

/// All panels, dialogs, help and legends for this frame.
[[nodiscard]] Requests draw_panels(Document& document, PanelState& state, const PanelView& view);

/// Closes the drop-down list or other pop-up that is open in the panels or over a dialog; returns whether there was one.
[[nodiscard]] bool close_drop_down();

}  // namespace splatray
