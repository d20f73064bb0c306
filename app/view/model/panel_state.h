/// What the panels remember, and what keys and buttons do to it; knows neither window nor Dear ImGui.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/library/request/request.h"
#include "app/view/model/document.h"
#include "app/view/model/folder_listing.h"
#include "app/view/model/keys.h"
#include "app/view/model/scene_files.h"

namespace splatray {

/// A picture that the save dialog first asks for: its size, samples, file and channels.
[[nodiscard]] Request first_save();
/// A drawing that the sheet dialog first asks for: of a section that is shown then.
[[nodiscard]] Request first_sheet();
/// Pictures that the record dialog first asks for: a turn about the pivot.
[[nodiscard]] Request first_record();

/// Long work under way.
struct Work {
  std::string stage;   ///< "reading dragon.ply"
  double share = 0.0;  ///< 0..1
};

inline constexpr int BOOKMARK_COUNT = 9;
inline constexpr double NOTICE_SECONDS = 10.0;  ///< after the work that they report

/// What the panels remember, and what is open.
struct PanelState {
  double ui_scale = 1.0;  ///< of fonts and sizes; 1 at 96 dots per inch
  bool show_panels = true, show_help = false, show_save = false, show_sheet = false, show_record = false,
       show_open = false;
  std::uint32_t object = 0;   ///< selected in the material panel
  std::uint32_t light = 0;    ///< selected in the light panel; what Action::drag_light drags
  std::string object_filter;  ///< part of the names listed
  bool shows_handles = true;  ///< of the region's boxes and planes, in the picture
  std::string measures_path = "measures.geojson";  ///< to be written
  std::optional<MeasureKind> measuring;            ///< what clicks in the picture add points to
  bool walks = false;                              ///< the fly keys move along the ground, without the mouse
  double walk_speed = 1.0;                         ///< factor on that of walk
  Camera home;                                     ///< as loaded
  std::array<std::optional<Camera>, BOOKMARK_COUNT> bookmarks;
  std::vector<SceneFiles> recent_files;       ///< newest first
  std::string open_path;                      ///< of the open dialog: what is written there
  std::optional<FolderListing> open_listing;  ///< what it shows; unset while it is closed
  SceneFiles open_chosen;                     ///< of that
  bool add = false;                           ///< of the open dialog: beside what is shown
  bool can_add = false;                       ///< something is shown
  Request save = first_save();
  Request sheet = first_sheet();
  Request record = first_record();
  std::string error;         ///< a sentence in a pop-up until closed; empty = none
  std::string notice;        ///< sentences in the status line, one a line, for NOTICE_SECONDS; empty = none
  std::string notice_shown;  ///< what the status line has begun to show
  double notice_end = 0.0;   ///< when it ends, by Dear ImGui's clock
};

/// Whether one of the dialogs is open: open, save, sheet, record, or the sentence of an error.
[[nodiscard]] bool dialog_is_open(const PanelState& state);

/// Does what needs neither window nor threads: camera, view mode, bookmarks, which panels are open. `aspect` of the
/// picture. Returns false when the command is the caller's: quit, copy_command, paste_command, pivot, inspect, drags, views of
/// --view, undo, redo, empty_cache, and escape when nothing was open to be closed and nothing went on.
[[nodiscard]] bool apply(const Command& command, double aspect, Document& document, PanelState& state);

}  // namespace splatray
