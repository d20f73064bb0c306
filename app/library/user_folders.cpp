#include "app/library/user_folders.h"

#include <cstdlib>

namespace splatray {
namespace {

std::filesystem::path user_folder(const char* variable, const char* below_home) {
  const char* named = std::getenv(variable);
  const char* home = std::getenv("HOME");
  std::filesystem::path folder = named != nullptr ? named : "";
  if (!folder.is_absolute()) {  // the specification: relative ones are invalid, to be ignored
    if (home == nullptr || *home == '\0') return {};
    folder = std::filesystem::path(home) / below_home;
  }
  return folder / "splatray";
}

}  // namespace

std::filesystem::path user_state_folder() { return user_folder("XDG_STATE_HOME", ".local/state"); }

std::filesystem::path user_cache_folder() { return user_folder("XDG_CACHE_HOME", ".cache"); }

}  // namespace splatray
