#include "app/view/thread/scene_cache.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <numeric>
#include <vector>

#include "app/library/commit.h"
#include "app/library/request/command_line.h"
#include "app/library/user_folders.h"
#include "app/view/model/scene_files.h"
#include "engine/base/error.h"
#include "engine/file/scene_file.h"
#include "preprocess/base/file_extension.h"
#include "preprocess/read/formats.h"

namespace splatray {
namespace {

namespace fs = std::filesystem;

/// Path, size and time of a file, of a folder those of what is in it.
void describe(const fs::path& path, std::string& text) {
  std::error_code failed;
  std::vector<fs::path> files = {path};
  if (fs::is_directory(path, failed)) {
    for (fs::directory_iterator entry(path, failed), end; !failed && entry != end; entry.increment(failed))
      files.push_back(entry->path());
    std::sort(files.begin() + 1, files.end());
  }
  for (const fs::path& file : files) {
    const auto time = fs::last_write_time(file, failed);
    text += plain_path(file).string() + '\0' + std::to_string(time.time_since_epoch().count()) + '\0';
    text += std::to_string(fs::is_regular_file(file, failed) ? fs::file_size(file, failed) : 0) + '\0';
  }
}

/// Whether a scene depends on files that this one names, or on what a server has.
bool names_others(const fs::path& path) {
  const Format* format = find_format(path);
  const std::string extension = lower_extension(path);
  return is_url(path) || extension == ".pvtp" || extension == ".pvtu" || extension == ".json" ||
         (format != nullptr && (format->read_scene != nullptr || format->read_list != nullptr));
}

/// What a made scene depends on beside its files' contents.
std::string options_of(const Request& request) {
  Request made;
  made.source = request.source;
  made.source.threads = 0;
  made.look.material = request.look.material;
  made.look.up = request.look.up;
  return command_line(made);
}

struct Kept {
  fs::path path;
  fs::file_time_type used;
  std::uint64_t bytes = 0;
};

/// The scenes in the folder, those not used for the longest time first.
std::vector<Kept> kept_in(const fs::path& folder) {
  std::vector<Kept> all;
  std::error_code failed;
  for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end; entry.increment(failed)) {
    std::error_code gone;
    if (entry->path().extension() != ".soct") continue;
    const Kept one{entry->path(), entry->last_write_time(gone), entry->file_size(gone)};
    if (!gone) all.push_back(one);
  }
  std::sort(all.begin(), all.end(), [](const Kept& a, const Kept& b) { return a.used < b.used; });
  return all;
}

std::uint64_t bytes_of(const std::vector<Kept>& all) {
  return std::accumulate(all.begin(), all.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const Kept& one) { return sum + one.bytes; });
}

}  // namespace

fs::path SceneCache::place_of(const Request& request) const {
  const Request::Source& source = request.source;
  if (folder_.empty() || source.inputs.empty()) return {};
  std::string text = std::string(COMMIT) + '\0' + options_of(request) + '\0';
  for (const fs::path& input : source.inputs) {
    if (is_scene_file(input) || names_others(input)) return {};
    describe(input, text);
  }
  if (!source.scans.trajectory.empty()) describe(source.scans.trajectory, text);
  const XXH128_hash_t hash = XXH3_128bits(text.data(), text.size());
  std::array<char, 40> name{};
  std::snprintf(name.data(), name.size(), "%016llx%016llx.soct", static_cast<unsigned long long>(hash.high64),
                static_cast<unsigned long long>(hash.low64));
  return folder_ / name.data();
}

std::optional<Scene> SceneCache::find(const Request& request, const Progress& progress) const {
  const fs::path place = place_of(request);
  std::error_code failed;
  if (place.empty() || !fs::is_regular_file(place, failed)) return {};
  try {
    Scene scene = read_scene(place, progress);
    const std::uint32_t leaf_size = scene.build.leaf_size;
    scene.build = request.source.params;  // which scene files do not hold all of
    scene.build.leaf_size = leaf_size;
    fs::last_write_time(place, fs::file_time_type::clock::now(), failed);
    return scene;
  } catch (const Error& error) {
    if (error.code() == ExitCode::interrupted) throw;
    fs::remove(place, failed);
    return {};
  }
}

void SceneCache::keep(const Request& request, const Scene& scene, const Progress& progress) const {
  const fs::path place = place_of(request);
  if (place.empty()) return;
  std::error_code failed;
  fs::create_directories(folder_, failed);
  try {
    write_scene(scene, place, progress);
  } catch (const Error&) {
    return;
  }
  make_room();
}

void SceneCache::make_room() const {
  std::vector<Kept> all = kept_in(folder_);
  std::uint64_t kept = bytes_of(all);
  std::error_code failed;
  const fs::space_info disk = fs::space(folder_, failed);
  const std::uint64_t most =
      failed ? most_bytes_ : std::min(most_bytes_, (disk.available + kept) / FREE_SHARE);
  for (const Kept& one : all) {
    if (kept <= most) return;
    fs::remove(one.path, failed);
    kept -= one.bytes;
  }
}

SceneCache user_scene_cache() {
  const fs::path folder = user_cache_folder();
  return SceneCache(folder.empty() ? folder : folder / "scenes");
}

std::uint64_t SceneCache::bytes() const { return bytes_of(kept_in(folder_)); }

void SceneCache::clear() const {
  std::error_code failed;
  for (const Kept& one : kept_in(folder_)) fs::remove(one.path, failed);
}

}  // namespace splatray
