/// Scenes that were made of files, so that the same files open at once the next time.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>

#include "app/library/request/request.h"
#include "engine/base/progress.h"
#include "engine/scene/scene.h"

namespace splatray {

/// A folder of scene files, shared with other windows. Its errors are ignored: scenes are made again.
class SceneCache {
 public:
  /// Most that is kept, and the share of what the disk has free that it takes at most.
  static constexpr std::uint64_t MOST_BYTES = std::uint64_t{8} << 30U;
  static constexpr std::uint64_t FREE_SHARE = 4;

  /// `folder` empty: nothing is kept.
  explicit SceneCache(std::filesystem::path folder, std::uint64_t most_bytes = MOST_BYTES)
      : folder_(std::move(folder)), most_bytes_(most_bytes) {}

  /// Where the scene of a request is kept: by path, size and time of its files, and by whatever else it depends on. Empty where
  /// it is not, as files that name others (glTF, VTK's pieces) do not show when those change, and a .soct needs no keeping.
  [[nodiscard]] std::filesystem::path place_of(const Request& request) const;
  /// The scene that keep() was given for an equal request while its files are as they were. A damaged one goes. Throws Error
  /// (interrupted) when `progress` says so.
  [[nodiscard]] std::optional<Scene> find(const Request& request, const Progress& progress) const;
  /// Keeps a scene as LoadedScene has it; those that were not used for the longest time make room.
  void keep(const Request& request, const Scene& scene, const Progress& progress) const;

  [[nodiscard]] std::uint64_t bytes() const;
  void clear() const;

 private:
  void make_room() const;

  std::filesystem::path folder_;
  std::uint64_t most_bytes_;
};

/// That in the user's cache folder (user_folders.h).
[[nodiscard]] SceneCache user_scene_cache();

}  // namespace splatray
