#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <utility>

#include "app/view/ui/dialog.h"
#include "app/view/ui/panel_parts.h"
#include "preprocess/read/formats.h"

namespace splatray {
namespace {

namespace fs = std::filesystem;

constexpr float FILE_LIST_EM = 13.0F;  ///< height of the list of files

/// Lists a folder; nothing of another is chosen any more.
void enter(PanelState& state, const fs::path& folder) {
  state.open_listing = list_folder(folder);
  state.open_chosen.clear();
}

/// Where one looks first: beside what was opened last.
fs::path first_folder(const PanelState& state) {
  std::error_code failed;
  for (const SceneFiles& files : state.recent_files)
    if (fs::is_directory(files.front().parent_path(), failed)) return files.front().parent_path();
  return fs::current_path(failed);
}

void toggle(SceneFiles& chosen, const fs::path& file) {
  const auto found = std::find(chosen.begin(), chosen.end(), file);
  found == chosen.end() ? static_cast<void>(chosen.push_back(file)) : static_cast<void>(chosen.erase(found));
}

/// A click enters a folder or chooses a file, or no longer; a double click on a file opens it.
void entry_row(const FolderEntry& entry, PanelState& state, Requests& requests,
               std::optional<fs::path>& entered) {
  const fs::path path = state.open_listing->folder / entry.name;
  if (entry.is_folder) {
    if (ImGui::Selectable((entry.name + "/").c_str(), false, ImGuiSelectableFlags_DontClosePopups))
      entered = path;
    return;
  }
  const bool chosen =
      std::find(state.open_chosen.begin(), state.open_chosen.end(), path) != state.open_chosen.end();
  constexpr ImGuiSelectableFlags FLAGS =
      ImGuiSelectableFlags_DontClosePopups | ImGuiSelectableFlags_AllowDoubleClick;
  if (ImGui::Selectable(entry.name.c_str(), chosen, FLAGS)) {
    toggle(state.open_chosen, path);
    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) requests.open = SceneFiles{path};
  }
  const std::string size = size_text(entry.bytes);
  ImGui::SameLine(ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(size.c_str()).x);
  ImGui::TextDisabled("%s", size.c_str());
}

void folder_list(PanelState& state, Requests& requests) {
  std::optional<fs::path> entered;
  ImGui::TextWrapped("%s", state.open_listing->folder.c_str());
  ImGui::BeginChild("files", {0.0F, FILE_LIST_EM * ImGui::GetFontSize()}, true);
  const fs::path above = state.open_listing->folder.parent_path();
  if (above != state.open_listing->folder &&
      ImGui::Selectable("../", false, ImGuiSelectableFlags_DontClosePopups))
    entered = above;
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(state.open_listing->entries.size()));
  while (clipper.Step())
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i)
      entry_row(state.open_listing->entries[static_cast<std::size_t>(i)], state, requests, entered);
  if (!state.open_listing->error.empty()) ImGui::TextDisabled("%s", state.open_listing->error.c_str());
  ImGui::EndChild();
  if (entered) enter(state, *entered);
}

/// What the dialog would open: the name that is written, else what is chosen.
SceneFiles asked_for(const PanelState& state) {
  return state.open_path.empty() ? state.open_chosen : SceneFiles{state.open_path};
}

}  // namespace

void open_dialog(PanelState& state, Requests& requests) {
  if (!state.show_open) {
    state.open_listing.reset();
    return;
  }
  if (!state.open_listing) enter(state, first_folder(state));
  Dialog dialog("Open", state.show_open);
  if (!dialog) return;
  const std::string hint = ".soct " + format_extensions();
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  const bool entered =
      ImGui::InputTextWithHint("file", hint.c_str(), &state.open_path, ImGuiInputTextFlags_EnterReturnsTrue);
  folder_list(state, requests);
  if (ImGui::SmallButton("all scans of this folder")) requests.open = SceneFiles{state.open_listing->folder};
  if (state.can_add) {
    ImGui::Checkbox("beside what is shown", &state.add);
    tip("loads the files shown and these together");
  }
  recent_list(state, requests);
  const SceneFiles asked = asked_for(state);
  const std::string refusal =
      asked.empty() ? "Choose files or name one; or drop files and folders on the window." : "";
  if (dialog.done_or_cancelled("open", refusal) || (entered && refusal.empty())) requests.open = asked;
  if (!requests.open) return;
  requests.add = std::exchange(state.add, false);
  state.open_path.clear();
  state.show_open = false;
}

}  // namespace splatray
