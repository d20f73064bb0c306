/// The parts that draw_panels is made of; Dear ImGui between NewFrame and Render. Panels go into the window begun, all others
/// make their own. Lengths are in em, the size of the font, so that they follow the display's scale.
#pragma once
#include "app/view/ui/panels.h"

namespace splatray {

void object_panel(Document& document, PanelState& state);
void material_panel(Document& document, PanelState& state);
void attribute_panel(Document& document, const PanelView& view);
/// How points and what moves are drawn.
void drawing_controls(Document& document);
void region_panel(Document& document, PanelState& state);
void measure_panel(Document& document, PanelState& state);
void light_panel(Document& document, PanelState& state);
void environment_panel(Document& document);
void quality_panel(Document& document, PanelState& state);
void camera_panel(Document& document, PanelState& state, Requests& requests);
/// Scenes kept for the next opening.
void cache_panel(const PanelView& view, Requests& requests);
void statistics_panel(const PanelView& view);
void inspector_panel(const PanelView& view);

/// Dialogs that are open in `state`: open, save, sheet, record, or the sentence of an error.
void open_dialog(PanelState& state, Requests& requests);
void save_dialog(const Document& document, PanelState& state, Requests& requests);
void sheet_dialog(const Document& document, PanelState& state, Requests& requests);
void record_dialog(PanelState& state, Requests& requests);
void error_dialog(PanelState& state);

/// Over the picture, which is `width_px` wide: at places of the scene, and at its edges.
void scene_marks(const Document& document, const PanelState& state, const PanelView& view, float width_px);
void status_line(const Document& document, PanelState& state, const PanelView& view, float width_px);
void work_bar(const PanelView& view, float width_px, Requests& requests);
void legend(const PanelView& view, float width_px);
void help_overlay(PanelState& state);
/// In place of a picture while no scene is open.
void welcome(const PanelState& state, float width_px, Requests& requests);

/// A button that asks for what a key does, with the table's words as its tip.
void command_button(const char* label, Action action, Requests& requests);
/// Recently opened files; a click asks for one.
void recent_list(const PanelState& state, Requests& requests);
/// A colour that is linear, edited as it is seen; returns whether it has changed.
bool color_edit(const char* label, glm::vec3& linear);
/// A square of a category's colour; the next item is beside it.
void category_swatch(const Category& category);
/// A tip for the item before.
void tip(const char* text);
/// Grey text with what it is, then the value.
void fact(const char* what, const std::string& value);

}  // namespace splatray
