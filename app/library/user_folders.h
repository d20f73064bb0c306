/// Where a user's own files are kept (XDG Base Directory Specification 0.8).
#pragma once
#include <filesystem>

namespace splatray {

/// $XDG_STATE_HOME/splatray, ~/.local/state/splatray without it: what the viewer remembers. Empty when neither XDG_STATE_HOME
/// (absolute) nor HOME is set. Need not exist.
[[nodiscard]] std::filesystem::path user_state_folder();
/// $XDG_CACHE_HOME/splatray, ~/.cache/splatray without it, likewise: compiled pipelines.
[[nodiscard]] std::filesystem::path user_cache_folder();

}  // namespace splatray
