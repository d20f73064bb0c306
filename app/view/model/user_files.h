/// What the viewer remembers between its runs: $XDG_STATE_HOME/splatray/view.json (XDG Base Directory Specification 0.8;
/// ~/.local/state without the variable).
#pragma once
#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/view/model/panel_state.h"
#include "app/view/model/scene_files.h"

namespace splatray {

using Bookmarks = std::array<std::optional<Camera>, BOOKMARK_COUNT>;

/// What a person likes to have in any scene.
struct Choices {
  double eye_dome = 1.0, point_size = 1.0;  ///< of Document; 0..100
  double walk_speed = 1.0;                  ///< of PanelState; 0..1000
  bool shows_handles = true;

  bool operator==(const Choices&) const = default;
};

/// What is remembered.
struct UserState {
  std::optional<glm::uvec2> window_size;       ///< screen coordinates, 320..16384; unset before the first run
  std::vector<SceneFiles> recent_files;        ///< newest first, at most RECENT_COUNT, absolute
  std::map<std::string, Bookmarks> bookmarks;  ///< by scene_name
  Choices choices;
};

inline constexpr std::size_t RECENT_COUNT = 10;
/// Size of a window where none is remembered.
inline constexpr glm::uvec2 DEFAULT_WINDOW{1280, 720};

/// Where it is kept; empty when neither XDG_STATE_HOME (absolute) nor HOME is set.
[[nodiscard]] std::filesystem::path user_state_path();
/// What is kept there; what is missing, unreadable or damaged has its default.
[[nodiscard]] UserState read_user_state(const std::filesystem::path& path);

/// What a person does to what is remembered.
using UserChange = std::function<void(UserState&)>;
/// Makes changes to what the file holds now, whole or not at all, while no other window changes it, and returns what it holds
/// then; creates file and folder. Throws Error (failed), also for a link and for a file that is not the viewer's: both stay.
[[nodiscard]] UserState change_user_state(const std::filesystem::path& path,
                                          const std::vector<UserChange>& changes);

/// What is remembered, shared with other windows: each change goes into the file at once.
class UserMemory {
 public:
  /// `path` empty: nothing is kept.
  explicit UserMemory(std::filesystem::path path) : path_(std::move(path)), state_(read_user_state(path_)) {}

  [[nodiscard]] const UserState& state() const { return state_; }
  /// Makes a change here and in the file. Throws Error (failed) where the file cannot take it; it then goes there with the next.
  void change(const UserChange& change);

 private:
  std::filesystem::path path_;
  UserState state_;
  std::vector<UserChange> unkept_;
};

/// Puts files (made absolute) first, once.
void remember_files(UserState& state, const SceneFiles& files);

}  // namespace splatray
