#include "app/view/model/user_files.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "app/library/user_folders.h"
#include "engine/base/error.h"
#include "engine/base/json_depth.h"
#include "engine/file/atomic_file.h"

namespace splatray {
namespace {

using nlohmann::json;

constexpr int LEAST_WINDOW = 320, LARGEST_WINDOW = 16384;

json to_json(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

json to_json(const Camera& camera) {
  return {{"eye", to_json(camera.eye)},
          {"target", to_json(camera.target)},
          {"up", to_json(camera.up)},
          {"fov_y_deg", camera.fov_y_deg},
          {"ortho_height", camera.ortho_height}};
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

/// Calls `read`; what it cannot make sense of keeps its default.
template <typename Read>
void if_sound(const Read& read) {
  try {
    read();
  } catch (const json::exception&) {
    return;
  }
}

}  // namespace

std::filesystem::path user_state_path() {
  const std::filesystem::path folder = user_state_folder();
  return folder.empty() ? folder : folder / "view.json";
}

UserState read_user_state(const std::filesystem::path& path) {
  UserState state;
  std::ifstream file(path);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (json_is_too_deep(text)) return state;
  const json all = json::parse(text, nullptr, false);
  if (!all.is_object()) return state;
  const auto window_edge = [&](const char* name, int& edge) {
    if_sound([&] {
      edge = static_cast<int>(
          std::clamp(all.at(name).get<double>(), double(LEAST_WINDOW), double(LARGEST_WINDOW)));
    });
  };
  window_edge("window_width", state.window_width);
  window_edge("window_height", state.window_height);
  if_sound([&] {
    for (const json& recent : all.at("recent_files"))
      if (state.recent_files.size() < RECENT_COUNT)
        state.recent_files.emplace_back(recent.get<std::string>());
  });
  if_sound([&] {
    for (const auto& scene : all.at("bookmarks").items())
      if_sound([&] { state.bookmarks[scene.key()] = bookmarks_of(scene.value()); });
  });
  return state;
}

void write_user_state(const UserState& state, const std::filesystem::path& path) {
  std::error_code failed;
  std::filesystem::create_directories(path.parent_path(), failed);
  if (failed)
    throw Error(ExitCode::failed, path.parent_path().string() + ": cannot make this folder (" +
                                      failed.message() + "), expected a place for the viewer's state");
  json all = {{"window_width", state.window_width}, {"window_height", state.window_height}};
  all["recent_files"] = json::array();
  for (const std::filesystem::path& file : state.recent_files) all["recent_files"].push_back(file.string());
  all["bookmarks"] = json::object();
  for (const auto& [scene, bookmarks] : state.bookmarks) all["bookmarks"][scene] = to_json(bookmarks);
  write_text_file(all.dump(2, ' ', false, json::error_handler_t::replace) + "\n", path, Links::refuse);
}

void remember_file(UserState& state, const std::filesystem::path& file) {
  std::error_code failed;
  const std::filesystem::path absolute = std::filesystem::absolute(file, failed).lexically_normal();
  const std::filesystem::path remembered = failed ? file : absolute;
  std::erase(state.recent_files, remembered);
  state.recent_files.insert(state.recent_files.begin(), remembered);
  if (state.recent_files.size() > RECENT_COUNT) state.recent_files.resize(RECENT_COUNT);
}

}  // namespace splatray
