#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <functional>

#include "app/library/camera_file.h"
#include "app/library/codec/picture_format.h"
#include "app/library/request/consistent.h"
#include "app/view/model/attempt.h"
#include "app/view/model/document_request.h"
#include "app/view/model/section_sheet.h"
#include "app/view/ui/dialog.h"
#include "app/view/ui/field_controls.h"
#include "app/view/ui/panel_parts.h"

namespace splatray {
namespace {

constexpr std::uint32_t LEAST = 1, MOST_EDGE = 32768, MOST_SAMPLES = 65536, MOST_FRAMES = 999999;

void edge_input(const char* label, std::uint32_t& value, std::uint32_t most) {
  ImGui::InputScalar(label, ImGuiDataType_U32, &value);
  value = std::clamp(value, LEAST, most);
}

/// A number above 0.
void number_input(const char* label, double& value, double most) {
  double typed = value;
  if (ImGui::InputScalar(label, ImGuiDataType_Double, &typed, nullptr, nullptr, "%.9g") && typed > 0.0)
    value = std::min(typed, most);
}

void path_input(const char* label, std::filesystem::path& path, const char* hint = "") {
  std::string text = path.string();
  if (ImGui::InputTextWithHint(label, hint, &text)) path = text;
}

/// Fields of a saved picture that have no control of their own in a dialog, in the order of the help.
void file_fields(Request& request, std::string& error, bool of_sequence) {
  for (const Field& field : fields())
    if (field.in(DOOR_VIEW) && field.group != FieldGroup::files && field.is(OF_FILES) &&
        !field.is(HAS_OWN_CONTROL) && (of_sequence || !field.is(OF_SEQUENCES)))
      field_control(field, request, error);
}

void size_inputs(std::uint32_t& width, std::uint32_t& height) {
  struct Size {
    const char* name;
    std::uint32_t width, height;
  };
  static constexpr std::array SIZES = {Size{"HD", 1280, 720}, Size{"full HD", 1920, 1080},
                                       Size{"4K", 3840, 2160}, Size{"square", 1024, 1024}};
  edge_input("width", width, MOST_EDGE);
  edge_input("height", height, MOST_EDGE);
  for (const Size& size : SIZES) {
    if (ImGui::SmallButton(size.name)) {
      width = size.width;
      height = size.height;
    }
    ImGui::SameLine();
  }
  ImGui::NewLine();
}

bool ends_in(const std::filesystem::path& path, const char* extension) {
  return path.extension() == extension;
}

std::string refusal_of_save(const Request& save) {
  if (is_picture_format(save.output.path) || ends_in(save.output.path, ".json")) return "";
  return std::string("The file's name must end in ") + PICTURE_NAMES + ", or in .json for the camera alone.";
}

std::string refusal_of_sheet(const Document& document, const Request& sheet) {
  const auto refusal = attempt("drawing", [&] { require_consistent(saved_request(document, sheet)); });
  return refusal ? refusal->sentence : "";
}

std::string refusal_of_record(const Request& record) {
  const Request::Output& output = record.output;
  if (output.path.string().find('#') == std::string::npos)
    return "The files' name needs #### where the number goes.";
  if (!output.many()) return "A camera path is needed.";
  return is_picture_format(output.path) ? ""
                                        : std::string("The files' name must end in ") + PICTURE_NAMES + ".";
}

/// Writes a camera file at once, small as it is.
void write_file(PanelState& state, const std::filesystem::path& path, const std::function<void()>& write) {
  if (const std::optional<Failure> failure = attempt("writing " + path.string(), write))
    state.error = failure->sentence;
  else
    state.notice = "Written: " + path.string();
}

bool is_ortho(const Camera& camera) { return camera.ortho_height > 0.0; }

/// The bookmarks, in their order, as keys of a camera path.
void write_bookmarks(PanelState& state) {
  CameraPath path;
  bool mixed = false;
  for (const std::optional<Camera>& bookmark : state.bookmarks) {
    if (!bookmark) continue;
    path.push_back({*bookmark, static_cast<std::uint32_t>(path.size()) * KEY_FRAMES});
    mixed |= is_ortho(*bookmark) != is_ortho(path.front().camera);
  }
  if (path.empty())
    state.error = "no bookmark is set, expected some: Shift and a number remember a camera";
  else if (mixed)
    state.error = "the bookmarks are both perspective and orthographic, expected one kind in a camera path";
  else
    write_file(state, state.record.output.camera_path,
               [&] { write_camera_path(path, state.record.output.camera_path); });
}

void path_inputs(PanelState& state) {
  path_input("path file", state.record.output.camera_path, "cameras.json");
  ImGui::BeginDisabled(!ends_in(state.record.output.camera_path, ".json"));
  if (ImGui::SmallButton("write the bookmarks there")) write_bookmarks(state);
  ImGui::EndDisabled();
}

}  // namespace

void save_dialog(const Document& document, PanelState& state, Requests& requests) {
  if (!state.show_save) return;
  Dialog dialog("Save the picture", state.show_save);
  if (!dialog) return;
  Request& save = state.save;
  path_input("file", save.output.path);
  size_inputs(save.view.width, save.view.height);
  edge_input("samples", save.settings.samples, MOST_SAMPLES);
  file_fields(save, state.error, /*of_sequence=*/false);
  if (!dialog.done_or_cancelled("save", refusal_of_save(save))) return;
  if (is_picture_format(save.output.path))
    requests.save = save;
  else
    write_file(state, save.output.path, [&] { write_camera(document.camera, save.output.path); });
}

void sheet_dialog(const Document& document, PanelState& state, Requests& requests) {
  if (!state.show_sheet) return;
  Dialog dialog("Save a drawing to scale", state.show_sheet);
  if (!dialog) return;
  Request& asked = state.sheet;
  SheetRequest& sheet = *asked.view.sheet;
  ImGui::TextWrapped("%s", sheet_sentence(sheet).c_str());
  path_input("file", asked.output.path, "sheet.pdf, .svg, .dxf, .tif, .png or .exr");
  number_input("scale 1:", sheet.scale, MOST_SHEET_SCALE);
  number_input("dpi", sheet.dpi, MOST_SHEET_DPI);
  edge_input("samples", asked.settings.samples, MOST_SAMPLES);
  for (const Field& field : fields())
    if (field.group == FieldGroup::sheet) field_control(field, asked, state.error);
  if (dialog.done_or_cancelled("save", refusal_of_sheet(document, asked))) requests.save = asked;
}

void record_dialog(PanelState& state, Requests& requests) {
  if (!state.show_record) return;
  Dialog dialog("Record", state.show_record);
  if (!dialog) return;
  Request& record = state.record;
  std::uint32_t& turntable = record.output.turntable;
  if (ImGui::RadioButton("turntable about the pivot", turntable > 0) && turntable == 0)
    turntable = first_record().output.turntable;
  if (ImGui::RadioButton("camera path", turntable == 0)) turntable = 0;
  if (turntable > 0)
    edge_input("turntable", turntable, MOST_FRAMES);
  else
    path_inputs(state);
  path_input("files", record.output.path);
  size_inputs(record.view.width, record.view.height);
  edge_input("samples", record.settings.samples, MOST_SAMPLES);
  file_fields(record, state.error, /*of_sequence=*/true);
  if (!dialog.done_or_cancelled("record", refusal_of_record(record))) return;
  requests.save = record;
  if (turntable > 0) requests.save->output.camera_path.clear();
}

void error_dialog(PanelState& state) {
  if (state.error.empty()) return;
  bool open = true;
  {
    Dialog dialog("That did not work", open);
    if (!dialog) return;
    ImGui::TextWrapped("%s", state.error.c_str());
    ImGui::Spacing();
    if (ImGui::Button("close")) open = false;
  }
  if (!open) state.error.clear();
}

}  // namespace splatray
