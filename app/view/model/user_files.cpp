#include "app/view/model/user_files.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/library/user_folders.h"
#include "engine/base/error.h"
#include "engine/base/json_depth.h"
#include "engine/base/json_text.h"
#include "engine/file/atomic_file.h"

namespace splatray {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr double LEAST_WINDOW = 320.0, LARGEST_WINDOW = 16384.0;

json to_json(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

json to_json(const Camera& camera) {
  return {{"eye", to_json(camera.eye)},
          {"target", to_json(camera.target)},
          {"up", to_json(camera.up)},
          {"fov_y_deg", camera.fov_y_deg},
          {"ortho_height", camera.ortho_height},
          {"lens_shift", {camera.lens_shift.x, camera.lens_shift.y}},
          {"pixel_aspect", camera.pixel_aspect}};
}

/// Throws json::exception unless the member is three numbers.
glm::dvec3 vector_of(const json& object, const char* name) {
  const json& v = object.at(name);
  return {v.at(0).get<double>(), v.at(1).get<double>(), v.at(2).get<double>()};
}

/// Throws json::exception.
Camera camera_of(const json& object) {
  Camera camera;
  camera.eye = vector_of(object, "eye");
  camera.target = vector_of(object, "target");
  camera.up = vector_of(object, "up");
  camera.fov_y_deg = object.at("fov_y_deg").get<double>();
  camera.ortho_height = object.at("ortho_height").get<double>();
  if (object.contains("lens_shift"))
    camera.lens_shift = {object["lens_shift"].at(0).get<double>(), object["lens_shift"].at(1).get<double>()};
  camera.pixel_aspect = object.value("pixel_aspect", 1.0);
  return camera;
}

/// A JSON array of BOOKMARK_COUNT cameras and nulls; throws json::exception.
Bookmarks bookmarks_of(const json& array) {
  Bookmarks bookmarks;
  for (std::size_t i = 0; i < bookmarks.size(); ++i)
    if (!array.at(i).is_null()) bookmarks[i] = camera_of(array.at(i));
  return bookmarks;
}

json to_json(const Bookmarks& bookmarks) {
  json array = json::array();
  for (const std::optional<Camera>& camera : bookmarks) array.push_back(camera ? to_json(*camera) : json());
  return array;
}

/// One file, or several that were opened together. Throws json::exception.
SceneFiles files_of(const json& recent) {
  if (!recent.is_array()) return {recent.get<std::string>()};
  SceneFiles files;
  for (const json& file : recent) files.emplace_back(file.get<std::string>());
  return files;
}

json to_json(const SceneFiles& files) {
  if (files.size() == 1) return files.front().string();
  json array = json::array();
  for (const fs::path& file : files) array.push_back(file.string());
  return array;
}

/// Calls `read`; what it cannot make sense of keeps its default.
template <typename Read>
void if_sound(const Read& read) {
  try {
    read();
  } catch (const json::exception&) {
    return;
  }
}

/// Reads what a text makes sense of.
UserState state_of(const json& all) {
  UserState state;
  if_sound([&] {
    const glm::dvec2 size(all.at("window_width").get<double>(), all.at("window_height").get<double>());
    state.window_size = glm::clamp(size, LEAST_WINDOW, LARGEST_WINDOW);
  });
  if_sound([&] {
    for (const json& recent : all.at("recent_files"))
      if (SceneFiles files = files_of(recent); !files.empty() && state.recent_files.size() < RECENT_COUNT)
        state.recent_files.push_back(std::move(files));
  });
  const auto number = [&](const char* name, double most, double& value) {
    if_sound([&] { value = std::clamp(all.at(name).get<double>(), 0.0, most); });
  };
  number("eye_dome", 100.0, state.choices.eye_dome);
  number("point_size", 100.0, state.choices.point_size);
  number("walk_speed", 1000.0, state.choices.walk_speed);
  if_sound([&] { state.choices.shows_handles = all.at("shows_handles").get<bool>(); });
  if_sound([&] {
    for (const auto& scene : all.at("bookmarks").items())
      if_sound([&] { state.bookmarks[scene.key()] = bookmarks_of(scene.value()); });
  });
  return state;
}

/// The JSON of a text; no object for any other text.
json parsed(const std::string& text) {
  return json_is_too_deep(text) ? json() : json::parse(text, nullptr, false);
}

std::string content(std::ifstream& file) { return {std::istreambuf_iterator<char>(file), {}}; }

[[noreturn]] void refuse(const fs::path& path, const std::string& found) {
  throw Error(ExitCode::failed, "cannot keep the viewer's state in '" + path.string() + "': " + found);
}

/// Throws Error (failed) for a file that the viewer did not write, as replacing it would lose it. An empty one holds nothing.
UserState own_state(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::symlink_status(path, error);
  if (status.type() == fs::file_type::not_found) return {};
  if (!fs::is_regular_file(status)) refuse(path, "found a link or no regular file, expected a file");
  std::ifstream file(path);
  if (!file) refuse(path, "it cannot be read");
  const std::string text = content(file);
  const json all = parsed(text);
  if (!text.empty() && !(all.is_object() && all.contains("recent_files")))
    refuse(path, "found a file of something else, expected the viewer's own; move it away");
  return state_of(all);
}

void write_state(const UserState& state, const fs::path& path) {
  json all = json::object();
  if (state.window_size) {
    all["window_width"] = state.window_size->x;
    all["window_height"] = state.window_size->y;
  }
  all["recent_files"] = json::array();
  for (const SceneFiles& files : state.recent_files) all["recent_files"].push_back(to_json(files));
  all["eye_dome"] = state.choices.eye_dome;
  all["point_size"] = state.choices.point_size;
  all["walk_speed"] = state.choices.walk_speed;
  all["shows_handles"] = state.choices.shows_handles;
  all["bookmarks"] = json::object();
  for (const auto& [scene, bookmarks] : state.bookmarks) all["bookmarks"][scene] = to_json(bookmarks);
  write_text_file(json_text(all, 2) + "\n", path, Links::refuse);
}

/// While it lives, no other process has a lock of this path. Locks end with their process.
class Lock {
 public:
  /// Throws Error (failed) where the path cannot be opened, or another process keeps it locked.
  explicit Lock(const fs::path& path)
      : descriptor_(open(path.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0600)) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point end = Clock::now() + std::chrono::seconds(3);
    while (descriptor_ >= 0 && flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      if (errno == EINTR) continue;
      if (errno == EWOULDBLOCK && Clock::now() < end) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        continue;
      }
      close(descriptor_);
      refuse(path, "another window keeps it locked");
    }
    if (descriptor_ < 0) refuse(path, std::generic_category().message(errno));
  }
  ~Lock() { close(descriptor_); }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  int descriptor_;
};

}  // namespace

fs::path user_state_path() {
  const fs::path folder = user_state_folder();
  return folder.empty() ? folder : folder / "view.json";
}

UserState read_user_state(const fs::path& path) {
  std::error_code failed;
  if (!fs::is_regular_file(path, failed)) return {};
  std::ifstream file(path);
  return state_of(parsed(content(file)));
}

UserState change_user_state(const fs::path& path, const std::vector<UserChange>& changes) {
  std::error_code failed;
  fs::create_directories(path.parent_path(), failed);
  if (failed)
    throw Error(ExitCode::failed, path.parent_path().string() + ": cannot make this folder (" +
                                      failed.message() + "), expected a place for the viewer's state");
  const Lock lock(fs::path(path).replace_extension(".lock"));
  UserState state = own_state(path);
  for (const UserChange& change : changes) change(state);
  write_state(state, path);
  return state;
}

void UserMemory::change(const UserChange& change) {
  change(state_);
  if (path_.empty()) return;
  unkept_.push_back(change);
  state_ = change_user_state(path_, unkept_);
  unkept_.clear();
}

void remember_files(UserState& state, const SceneFiles& files) {
  SceneFiles remembered;
  for (const fs::path& file : files) remembered.push_back(plain_path(file));
  std::erase(state.recent_files, remembered);
  state.recent_files.insert(state.recent_files.begin(), std::move(remembered));
  if (state.recent_files.size() > RECENT_COUNT) state.recent_files.resize(RECENT_COUNT);
}

}  // namespace splatray
