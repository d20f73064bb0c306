#include <algorithm>
#include <array>
#include <cmath>

#include "app/view/model/false_color.h"
#include "app/view/model/navigation.h"
#include "app/view/model/panel_state.h"
#include "app/view/model/region_edit.h"
#include "app/view/model/section_sheet.h"

namespace splatray {
namespace {

/// Closes the topmost thing that is open; returns whether there was one.
bool close_topmost(PanelState& state) {
  if (!state.error.empty()) {
    state.error.clear();
    return true;
  }
  for (bool* open :
       {&state.show_open, &state.show_save, &state.show_sheet, &state.show_record, &state.show_help}) {
    if (!*open) continue;
    *open = false;
    return true;
  }
  const bool goes_on = state.measuring || state.walks;
  state.measuring.reset();
  state.walks = false;
  return goes_on;
}

void toggle_box(Document& document, PanelState& state) {
  std::optional<TurnedBox>& box = document.request.view.region.keep_box;
  box = box ? std::nullopt : std::optional(box_of_all(document));
  state.shows_handles = true;
}

/// Level, along the scene, across it, none.
void next_section(Document& document, PanelState& state) {
  constexpr std::array ORDER = {1, 2, 0};
  const std::optional<Slice> slice = slice_of(document.request.view.region);
  std::size_t next = 0;
  const glm::dmat3 axes = upright_axes(up_of(document));
  for (std::size_t i = 0; slice && i < ORDER.size(); ++i)
    if (std::abs(glm::dot(slice->normal, axes[ORDER[i]])) > 0.5) next = i + 1;
  if (next < ORDER.size())
    set_slice(document.request.view.region, first_slice(document, ORDER[next]));
  else
    remove_slice(document.request.view.region);
  state.shows_handles = true;
}

void next_measure(PanelState& state) {
  const int next = state.measuring ? static_cast<int>(*state.measuring) + 1 : 0;
  state.measuring = next < MARKED_KINDS ? std::optional(static_cast<MeasureKind>(next)) : std::nullopt;
  state.notice =
      state.measuring ? std::string("measure: ") + measure_name(*state.measuring) : "measure: none";
}

void take_back_point(Document& document) {
  if (document.measures.empty()) return;
  std::vector<SurfacePoint>& points = document.measures.back().points;
  if (!points.empty()) points.pop_back();
  if (points.empty()) document.measures.pop_back();
}

/// What changes the region, measures or how one moves; returns whether the action is one of them.
bool apply_to_edit(Action action, Document& document, PanelState& state) {
  switch (action) {
    case Action::look_in:
      document.request.view.look_in = !document.request.view.look_in;
      return true;
    case Action::walk:
      state.walks = !state.walks;
      return true;
    case Action::box:
      toggle_box(document, state);
      return true;
    case Action::section:
      next_section(document, state);
      return true;
    case Action::handles:
      state.shows_handles = !state.shows_handles;
      return true;
    case Action::measure:
      next_measure(state);
      return true;
    case Action::unpoint:
      take_back_point(document);
      return true;
    default:
      return false;
  }
}

void next_up_axis(Document& document) {
  int axis = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(up_of(document)[i]) > std::abs(up_of(document)[axis])) axis = i;
  glm::dvec3 up(0.0);
  up[(axis + 1) % 3] = 1.0;
  set_up_axis(document, up);
}

void change_mode(Document& document, int step) {
  document.mode =
      static_cast<ViewMode>((static_cast<int>(document.mode) + step + VIEW_MODE_COUNT) % VIEW_MODE_COUNT);
}

std::string numbered(const char* before, int digit, const char* after) {
  return before + std::to_string(digit) + after;
}

void bookmark(const Command& command, Document& document, PanelState& state) {
  if (command.digit < 1 || command.digit > BOOKMARK_COUNT) return;
  std::optional<Camera>& kept = state.bookmarks[static_cast<std::size_t>(command.digit - 1)];
  if (command.action == Action::bookmark_set) {
    kept = document.camera;
    state.notice = numbered("Bookmark ", command.digit, " is this camera.");
  } else if (kept) {
    document.camera = *kept;
  } else {
    state.notice = numbered("Bookmark ", command.digit, " is not set: Shift and its number set it.");
  }
}

/// What moves the camera; returns whether the action is one of them.
bool apply_to_camera(Action action, double aspect, Document& document, const PanelState& state) {
  switch (action) {
    case Action::frame_all:
      frame_all(document, aspect);
      return true;
    case Action::home:
      document.camera = state.home;
      return true;
    case Action::view_front:
      set_axis_view(document, AxisView::front);
      return true;
    case Action::view_back:
      set_axis_view(document, AxisView::back);
      return true;
    case Action::view_right:
      set_axis_view(document, AxisView::right);
      return true;
    case Action::view_left:
      set_axis_view(document, AxisView::left);
      return true;
    case Action::view_top:
      set_axis_view(document, AxisView::top);
      return true;
    case Action::view_bottom:
      set_axis_view(document, AxisView::bottom);
      return true;
    case Action::orthographic:
      toggle_orthographic(document);
      return true;
    case Action::up_axis:
      next_up_axis(document);
      return true;
    default:
      return false;
  }
}

}  // namespace

bool apply(const Command& command, double aspect, Document& document, PanelState& state) {
  if (command.action == Action::escape) return close_topmost(state);
  if (command.action == Action::quit) return false;
  if (dialog_is_open(state)) return true;
  if (apply_to_camera(command.action, aspect, document, state)) return true;
  if (apply_to_edit(command.action, document, state)) return true;
  switch (command.action) {
    case Action::help:
      state.show_help = !state.show_help;
      return true;
    case Action::panels:
      state.show_panels = !state.show_panels;
      return true;
    case Action::open:
      state.show_open = true;
      return true;
    case Action::save:
      state.show_save = true;
      return true;
    case Action::sheet:
      state.sheet.view.sheet = section_sheet(document, *state.sheet.view.sheet);
      state.show_sheet = true;
      return true;
    case Action::record:
      state.show_record = true;
      return true;
    case Action::mode_next:
      change_mode(document, 1);
      return true;
    case Action::mode_previous:
      change_mode(document, -1);
      return true;
    case Action::bookmark_go:
    case Action::bookmark_set:
      bookmark(command, document, state);
      return true;
    default:
      return false;
  }
}

}  // namespace splatray
