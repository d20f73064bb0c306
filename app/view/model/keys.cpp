#include "app/view/model/keys.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <iterator>

namespace splatray {
namespace {

constexpr int SHIFT = GLFW_MOD_SHIFT, CTRL = GLFW_MOD_CONTROL, ALT = GLFW_MOD_ALT;
constexpr int MODIFIERS = SHIFT | CTRL | ALT;
constexpr int LEFT = GLFW_MOUSE_BUTTON_LEFT, MIDDLE = GLFW_MOUSE_BUTTON_MIDDLE,
              RIGHT = GLFW_MOUSE_BUTTON_RIGHT;

constexpr Binding key(Action action, int code, int modifiers, const char* does) {
  return {action, InputKind::key, code, code, modifiers, does};
}
constexpr Binding digits(Action action, int modifiers, const char* does) {
  return {action, InputKind::key, GLFW_KEY_1, GLFW_KEY_9, modifiers, does};
}
constexpr Binding mouse(Action action, InputKind input, int button, int modifiers, const char* does) {
  return {action, input, button, button, modifiers, does};
}
constexpr Binding flight(Action action, int code, const char* does) {
  return {action, InputKind::fly_key, code, code, 0, does};
}

constexpr std::array KEY_BINDINGS = {
    mouse(Action::orbit, InputKind::drag, LEFT, 0,
          "orbit about the point under the cursor, where there is none about the middle; drag a handle"),
    mouse(Action::pan, InputKind::drag, MIDDLE, 0, "pan: the point taken hold of stays under the cursor"),
    mouse(Action::pan, InputKind::drag, LEFT, SHIFT, ""),
    mouse(Action::zoom, InputKind::wheel, 0, 0, "zoom to the cursor"),
    mouse(Action::move_slice, InputKind::wheel, 0, CTRL, "move the slice"),
    mouse(Action::look, InputKind::drag, RIGHT, 0, "look around from where you are"),
    flight(Action::fly, GLFW_KEY_W,
           "while the right button is down: fly forward, left, back, right, down, up"),
    flight(Action::fly, GLFW_KEY_A, ""),
    flight(Action::fly, GLFW_KEY_S, ""),
    flight(Action::fly, GLFW_KEY_D, ""),
    flight(Action::fly, GLFW_KEY_Q, ""),
    flight(Action::fly, GLFW_KEY_E, ""),
    flight(Action::fly_fast, GLFW_KEY_LEFT_SHIFT, "while flying or walking: five times as fast"),
    key(Action::walk, GLFW_KEY_G, 0,
        "walk: the keys above move along the ground without the mouse, left drag looks around, the wheel "
        "changes the speed"),
    mouse(Action::pivot, InputKind::double_click, LEFT, 0, "make the point under the cursor the pivot"),
    mouse(Action::pivot, InputKind::click, MIDDLE, 0, ""),
    mouse(Action::inspect, InputKind::click, LEFT, 0,
          "inspect the splat under the cursor; while measuring, add the point there"),
    mouse(Action::drag_light, InputKind::drag, LEFT, CTRL,
          "drag the light selected in the panel about the scene"),
    key(Action::frame_all, GLFW_KEY_F, 0, "frame the whole scene"),
    key(Action::home, GLFW_KEY_HOME, 0, "the camera as it was loaded"),
    key(Action::view_front, GLFW_KEY_1, 0, "view from the front, the right, the top"),
    key(Action::view_right, GLFW_KEY_3, 0, ""),
    key(Action::view_top, GLFW_KEY_7, 0, ""),
    key(Action::view_back, GLFW_KEY_1, CTRL, "view from the back, the left, below"),
    key(Action::view_left, GLFW_KEY_3, CTRL, ""),
    key(Action::view_bottom, GLFW_KEY_7, CTRL, ""),
    key(Action::next_viewpoint, GLFW_KEY_V, 0,
        "next of the views: front, oblique, top, inside, dollhouse (open to the eye), sensor"),
    key(Action::view_oblique, GLFW_KEY_2, 0, "view oblique, inside, dollhouse, from the sensor"),
    key(Action::view_inside, GLFW_KEY_4, 0, ""),
    key(Action::view_dollhouse, GLFW_KEY_6, 0, ""),
    key(Action::view_sensor, GLFW_KEY_8, 0, ""),
    key(Action::look_in, GLFW_KEY_L, 0,
        "look in: leave out what faces away, such as walls and ceilings before a room"),
    key(Action::orthographic, GLFW_KEY_5, 0, "perspective or orthographic"),
    key(Action::box, GLFW_KEY_B, 0, "a box to look into, or none; its faces have handles"),
    key(Action::section, GLFW_KEY_X, 0,
        "next section: a slice that is level, along the scene, across it, none"),
    key(Action::handles, GLFW_KEY_K, 0, "show or hide the handles of boxes and planes"),
    key(Action::measure, GLFW_KEY_T, 0, "next measure: point, distance, height, angle, area, none"),
    key(Action::unpoint, GLFW_KEY_BACKSPACE, 0, "take back the last point measured"),
    key(Action::undo, GLFW_KEY_Z, CTRL, "undo what changed but the camera; redo"),
    key(Action::redo, GLFW_KEY_Z, CTRL | SHIFT, ""),
    key(Action::up_axis, GLFW_KEY_U, 0, "next up axis: y, z, x"),
    digits(Action::bookmark_set, SHIFT, "remember the camera as a bookmark of this scene"),
    digits(Action::bookmark_go, ALT, "go to a bookmark"),
    key(Action::mode_next, GLFW_KEY_M, 0, "next view mode: shaded, normal, depth and others"),
    key(Action::mode_previous, GLFW_KEY_M, SHIFT, "previous view mode"),
    key(Action::open, GLFW_KEY_O, CTRL,
        "open files and folders; or drop them on the window, with Shift beside what is shown"),
    key(Action::save, GLFW_KEY_S, 0, "save the picture, at any size and number of samples"),
    key(Action::save, GLFW_KEY_S, CTRL, ""),
    key(Action::sheet, GLFW_KEY_P, 0, "save a plan, section or elevation to scale of what is shown"),
    key(Action::record, GLFW_KEY_R, 0, "record a turntable or a camera path"),
    key(Action::copy_command, GLFW_KEY_C, CTRL, "copy the view as a command line of splatray-render"),
    key(Action::paste_command, GLFW_KEY_V, CTRL, "take the view from a command line that was copied"),
    key(Action::empty_cache, GLFW_KEY_DELETE, CTRL, "empty the cache of scenes made before"),
    key(Action::panels, GLFW_KEY_TAB, 0, "show or hide the panels"),
    key(Action::help, GLFW_KEY_H, 0, "show or hide these keys"),
    key(Action::escape, GLFW_KEY_ESCAPE, 0,
        "close what is open: message, dialog, help; with nothing open, end measuring and walking, then stop "
        "loading, saving or recording; "
        "never ends the program"),
    key(Action::quit, GLFW_KEY_Q, CTRL, "quit, as closing the window does"),
};

const char* key_name(int code) {
  switch (code) {
    case GLFW_KEY_HOME:
      return "Home";
    case GLFW_KEY_BACKSPACE:
      return "Backspace";
    case GLFW_KEY_DELETE:
      return "Delete";
    case GLFW_KEY_TAB:
      return "Tab";
    case GLFW_KEY_ESCAPE:
      return "Esc";
    case GLFW_KEY_LEFT_SHIFT:
      return "Shift";
    default:
      return nullptr;
  }
}

std::string input_name(const Binding& binding) {
  static constexpr std::array BUTTONS = {"left", "right", "middle"};  // in the order of GLFW_MOUSE_BUTTON_*
  switch (binding.input) {
    case InputKind::wheel:
      return "wheel";
    case InputKind::drag:
      return std::string(BUTTONS[binding.code]) + " drag";
    case InputKind::click:
      return std::string(BUTTONS[binding.code]) + " click";
    case InputKind::double_click:
      return "double click";
    case InputKind::key:
    case InputKind::fly_key:
      break;
  }
  if (const char* name = key_name(binding.code)) return name;
  const std::string first(1, static_cast<char>(binding.code));
  return binding.code == binding.last_code ? first : first + ".." + static_cast<char>(binding.last_code);
}

}  // namespace

std::span<const Binding> bindings() { return KEY_BINDINGS; }

std::optional<Command> command_for(InputKind input, int code, int modifiers) {
  if (input == InputKind::key && code >= GLFW_KEY_KP_0 && code <= GLFW_KEY_KP_9)
    code += GLFW_KEY_0 - GLFW_KEY_KP_0;
  for (const Binding& binding : KEY_BINDINGS) {
    if (binding.input != input || code < binding.code || code > binding.last_code) continue;
    if (binding.modifiers != (modifiers & MODIFIERS)) continue;
    return Command{binding.action, binding.code == binding.last_code ? 0 : code - GLFW_KEY_0};
  }
  return std::nullopt;
}

glm::dvec3 fly_direction(const std::function<bool(int)>& is_down) {
  const auto axis = [&](int positive, int negative) {
    return double(is_down(positive)) - double(is_down(negative));
  };
  return {axis(GLFW_KEY_D, GLFW_KEY_A), axis(GLFW_KEY_E, GLFW_KEY_Q), axis(GLFW_KEY_W, GLFW_KEY_S)};
}

std::string binding_name(const Binding& binding) {
  std::string name;
  if ((binding.modifiers & CTRL) != 0) name += "Ctrl+";
  if ((binding.modifiers & ALT) != 0) name += "Alt+";
  if ((binding.modifiers & SHIFT) != 0) name += "Shift+";
  return name + input_name(binding);
}

std::vector<KeyRow> key_rows() {
  std::vector<KeyRow> rows;
  for (const Binding& binding : KEY_BINDINGS) {
    if (*binding.does != '\0')
      rows.push_back({binding_name(binding), binding.does});
    else
      rows.back().keys += ", " + binding_name(binding);
  }
  return rows;
}

std::string keys_markdown() {
  std::string text = "| key or mouse | what it does |\n| --- | --- |\n";
  for (const KeyRow& row : key_rows()) text += "| " + row.keys + " | " + row.does + " |\n";
  return text;
}

}  // namespace splatray
