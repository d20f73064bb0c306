/// The panels over the picture: what a person sees and changes. Dear ImGui between NewFrame and Render; no window.
#pragma once
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/library/request/request.h"
#include "app/view/model/document.h"
#include "app/view/model/frame.h"
#include "app/view/model/keys.h"
#include "app/view/model/scene_files.h"

namespace splatray {

/// A picture that the save dialog first asks for: its size, samples, file and channels.
[[nodiscard]] Request first_save();
/// Pictures that the record dialog first asks for: a turn about the pivot.
[[nodiscard]] Request first_record();

/// What a person asked for in the panels, beyond changes of the document.
struct Requests {
  std::vector<Command> commands;   ///< buttons that do what a key does
  std::optional<SceneFiles> open;  ///< a scene
  bool add = false;                ///< `open` goes beside what is shown
  std::optional<Request> save;     ///< a picture or several; only what is_of_files() is looked at
  std::optional<Request> change;   ///< the document becomes what this asks for
  bool cancel = false;  ///< stop the work that PanelView::work shows
};

/// Long work under way.
struct Work {
  std::string stage;   ///< "reading dragon.ply"
  double share = 0.0;  ///< 0..1
};

/// What the panels show beside the document.
struct PanelView {
  const Frame* frame = nullptr;          ///< newest; null before the first
  const Inspected* inspected = nullptr;  ///< null: nothing inspected
  double frames_per_second = 0.0;        ///< pictures handed to the window
  const Work* work = nullptr;            ///< loading, saving or recording; null when idle
};

inline constexpr int BOOKMARK_COUNT = 9;
inline constexpr double NOTICE_SECONDS = 10.0;  ///< after the work that they tell of

/// What the panels remember, and what is open.
struct PanelState {
  double ui_scale = 1.0;  ///< of fonts and sizes; 1 at 96 dots per inch
  bool show_panels = true, show_help = false, show_save = false, show_record = false, show_open = false;
  std::uint32_t object = 0;   ///< selected in the material panel
  std::uint32_t light = 0;    ///< selected in the light panel; what Action::drag_light drags
  std::string object_filter;  ///< part of the names listed
  Camera home;                ///< as loaded
  std::array<std::optional<Camera>, BOOKMARK_COUNT> bookmarks;
  std::vector<SceneFiles> recent_files;  ///< newest first
  std::string open_path;                 ///< of the open dialog
  bool add = false;                      ///< of the open dialog: beside what is shown
  bool can_add = false;                  ///< something is shown
  Request save = first_save();
  Request record = first_record();
  std::string error;         ///< a sentence in a pop-up until closed; empty = none
  std::string notice;        ///< sentences in the status line, one a line, for NOTICE_SECONDS; empty = none
  std::string notice_shown;  ///< what the status line has begun to show
  double notice_end = 0.0;   ///< when it ends, by Dear ImGui's clock
};

/// Font and colours for `ui_scale`; replaces the font atlas (its texture must be uploaded anew).
void set_style(double ui_scale);

/// Width of the column of panels on the right, window pixels; 0 when hidden. The picture is to the left of it.
[[nodiscard]] float panel_column_px(const PanelState& state, float window_width_px);

/// All panels, dialogs, help and legends for this frame.
[[nodiscard]] Requests draw_panels(Document& document, PanelState& state, const PanelView& view);

/// Closes the drop-down list or other pop-up that is open in the panels or over a dialog; returns whether there was one.
[[nodiscard]] bool close_drop_down();

/// Does what needs neither window nor threads: camera, view mode, bookmarks, which panels are open. `aspect` of the
/// picture. Returns false when the command is the caller's: quit, copy_command, paste_command, pivot, inspect, drags,
/// and escape when nothing was open to be closed.
[[nodiscard]] bool apply(const Command& command, double aspect, Document& document, PanelState& state);

}  // namespace splatray
