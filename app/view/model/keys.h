/// The one table of what keys and mouse do: the viewer acts by it, and its help, --help and the README show it.
#pragma once
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace splatray {

/// What a person asks for.
enum class Action {
  escape,         ///< closes the topmost dialog or help; with none open, cancels what is under way
  quit,           ///< ends the program
  help,           ///< shows or hides the keys
  panels,         ///< shows or hides the panels
  open,           ///< asks for a file
  save,           ///< opens the dialog that saves the picture
  sheet,          ///< opens the dialog that saves a drawing of the section shown
  record,         ///< opens the dialog that records a turntable or camera path
  copy_command,   ///< the view as a command line, to the clipboard
  paste_command,  ///< a command line from the clipboard, to the view
  frame_all,      ///< the whole scene
  home,           ///< the camera as loaded
  view_front,     ///< axis views
  view_back,
  view_right,
  view_left,
  view_top,
  view_bottom,
  next_viewpoint,  ///< those of --view in turn
  view_oblique,    ///< others of --view
  view_inside,
  view_dollhouse,
  view_sensor,
  look_in,       ///< leaves out what faces away from the eye
  orthographic,  ///< perspective or orthographic
  up_axis,       ///< x, y, z in turn
  mode_next,     ///< next ViewMode
  mode_previous,
  bookmark_go,   ///< digit 1..9
  bookmark_set,  ///< digit 1..9
  orbit,         ///< drags
  pan,
  look,        ///< and fly while it lasts
  drag_light,  ///< the light selected in the panel
  zoom,        ///< wheel
  pivot,       ///< the point under the cursor becomes the pivot
  inspect,     ///< the splat under the cursor
  walk,        ///< the fly keys move along the ground, without the mouse
  box,         ///< a box that is kept, or none
  section,     ///< a slice: level, across two axes, none
  move_slice,  ///< wheel
  handles,     ///< of boxes and planes, shown or not
  measure,     ///< the next kind, or none
  unpoint,     ///< takes a measure's last point away
  undo,        ///< what changed but the camera
  redo,
  empty_cache,  ///< removes the scenes that are kept
  fly,          ///< keys held while look lasts
  fly_fast,
};

/// What happens on keyboard or mouse.
enum class InputKind { key, fly_key, drag, click, double_click, wheel };

/// One row of the table.
struct Binding {
  Action action;
  InputKind input;
  int code;  ///< key: GLFW_KEY_*, by its place on a US keyboard; drag, click: GLFW_MOUSE_BUTTON_*; else 0
  int last_code;     ///< codes code..last_code are meant; equal but for digits
  int modifiers;     ///< GLFW_MOD_SHIFT, _CONTROL, _ALT; all that are held, no other
  const char* does;  ///< in words; empty: as in the row before
};

/// An action with its digit.
struct Command {
  Action action;
  int digit = 0;  ///< of bookmarks: 1..9
};

/// All rows, in the order in which they are shown.
[[nodiscard]] std::span<const Binding> bindings();

/// What an input asks for; digits of the number pad count as digits. `code` and `modifiers` as in Binding (other
/// modifiers, such as caps lock, are not looked at). For key, drag, click and double_click.
[[nodiscard]] std::optional<Command> command_for(InputKind input, int code, int modifiers);

/// The direction to fly in for the keys that are down (right, up, forward; each -1, 0 or 1). `is_down` gets GLFW_KEY_*.
[[nodiscard]] glm::dvec3 fly_direction(const std::function<bool(int)>& is_down);

/// "Ctrl+S", "Shift+1..9", "right drag".
[[nodiscard]] std::string binding_name(const Binding& binding);

/// One line of the shown table: the names of all bindings of consecutive rows that share their words.
struct KeyRow {
  std::string keys;  ///< "W, A, S, D, Q, E"
  std::string does;
};
[[nodiscard]] std::vector<KeyRow> key_rows();
/// The table in Markdown for the README; lines end with a newline.
[[nodiscard]] std::string keys_markdown();

}  // namespace splatray
