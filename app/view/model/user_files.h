/// What the viewer remembers between its runs: $XDG_STATE_HOME/splatray/view.json (XDG Base Directory Specification 0.8;
/// ~/.local/state without the variable).
#pragma once
#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/view/ui/panels.h"

namespace splatray {

using Bookmarks = std::array<std::optional<Camera>, BOOKMARK_COUNT>;

/// What is remembered.
struct UserState {
  int window_width = 1280, window_height = 720;     ///< screen coordinates, 320..16384
  std::vector<std::filesystem::path> recent_files;  ///< newest first, at most RECENT_COUNT, absolute
  std::map<std::string, Bookmarks> bookmarks;       ///< by absolute path of the scene
};

inline constexpr std::size_t RECENT_COUNT = 10;

/// Where it is kept; empty when neither XDG_STATE_HOME (absolute) nor HOME is set.
[[nodiscard]] std::filesystem::path user_state_path();
/// What is kept there; what is missing, unreadable or damaged has its default.
[[nodiscard]] UserState read_user_state(const std::filesystem::path& path);
/// Replaces it, whole or not at all; creates the folder. Throws Error (failed).
void write_user_state(const UserState& state, const std::filesystem::path& path);

/// Puts a file (made absolute) first, once.
void remember_file(UserState& state, const std::filesystem::path& file);

}  // namespace splatray
