#include "app/view/model/user_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "engine/base/error.h"
#include "tests/readers/read_error.h"

namespace splatray {
namespace {

/// Sets a variable of the environment for a scope; nullptr removes it.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    value != nullptr ? setenv(name, value, 1) : unsetenv(name);
  }
  ~Variable() { before_ ? setenv(name_, before_->c_str(), 1) : unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> before_;
};

/// Makes the file hold this.
void keep(const UserState& state, const std::filesystem::path& path) {
  (void)change_user_state(path, {[&state](UserState& kept) { kept = state; }});
}

UserState some_state() {
  UserState state;
  state.window_size = glm::uvec2(1601, 902);
  state.recent_files = {{"/data/b.ply"}, {"/data/a.ply", "/data/c d.ply"}};
  state.bookmarks["/data/a.ply"][2] =
      Camera{{560000.123456789, 5.9e6, -1e-9}, {1, 2, 3}, {0, 0, 1}, 33.5, 0.25};
  return state;
}

TEST(UserFilesTest, PlaceFollowsXdg) {
  const Variable home("HOME", "/someone");
  {
    const Variable xdg("XDG_STATE_HOME", "/state");
    EXPECT_EQ(user_state_path(), "/state/splatray/view.json");
  }
  for (const char* invalid : {static_cast<const char*>(nullptr), "", "relative"}) {
    const Variable xdg("XDG_STATE_HOME", invalid);
    EXPECT_EQ(user_state_path(), "/someone/.local/state/splatray/view.json");
  }
  const Variable no_home("HOME", nullptr), no_xdg("XDG_STATE_HOME", nullptr);
  EXPECT_TRUE(user_state_path().empty());
}

TEST(UserFilesTest, WhatIsWrittenIsReadBack) {
  const TempFolder folder;
  const std::filesystem::path path = folder.path() / "new" / "splatray" / "view.json";
  const UserState state = some_state();
  keep(state, path);
  keep(state, path);  // replaces
  const UserState read = read_user_state(path);
  EXPECT_EQ(read.window_size, state.window_size);
  EXPECT_EQ(read.recent_files, state.recent_files);
  EXPECT_EQ(read.bookmarks, state.bookmarks);
}

TEST(UserFilesTest, DamageAtAnyByteGivesDefaultsAtWorst) {
  const TempFolder folder;
  const std::filesystem::path path = folder.path() / "view.json";
  keep(some_state(), path);
  std::ifstream file(path);
  const std::string whole((std::istreambuf_iterator<char>(file)), {});
  for (std::size_t length = 0; length < whole.size(); length += 7) {
    folder.write("view.json", whole.substr(0, length));
    const UserState read = read_user_state(path);
    EXPECT_FALSE(read.window_size);
    EXPECT_TRUE(read.recent_files.empty() && read.bookmarks.empty());
  }
}

TEST(UserFilesTest, WrongMembersHaveTheirDefaultsAndSoundOnesStay) {
  const TempFolder folder;
  const std::filesystem::path path = folder.path() / "view.json";
  EXPECT_FALSE(read_user_state(path).window_size);  // missing
  folder.write("view.json", R"({"window_width": 640, "bookmarks": )" + std::string(200000, '[') +
                                std::string(200000, ']') + "}");
  EXPECT_FALSE(read_user_state(path).window_size);
  for (const char* text : {"[]", "7", "null", "{}", "\"\"", "{\"window_width\": \"wide\"}"}) {
    folder.write("view.json", text);
    EXPECT_FALSE(read_user_state(path).window_size) << text;
  }
  folder.write("view.json", R"({"window_width": 1e300, "window_height": -5, "recent_files": 3,
                  "bookmarks": {"/a": [null], "/b": [null,null,null,null,null,null,null,null,
                  {"eye":[1,2,3],"target":[0,0,0],"up":[0,1,0],"fov_y_deg":30,"ortho_height":0}]}})");
  const UserState read = read_user_state(path);
  EXPECT_EQ(read.window_size, glm::uvec2(16384, 320));
  EXPECT_TRUE(read.recent_files.empty());
  EXPECT_FALSE(read.bookmarks.contains("/a"));
  EXPECT_EQ(read.bookmarks.at("/b")[8]->eye, glm::dvec3(1, 2, 3));
}

TEST(UserFilesTest, NoFolderIsASentence) {
  const TempFolder folder;
  folder.write("file", "");
  EXPECT_THROW(keep({}, folder.path() / "file" / "view.json"), Error);
}

TEST(UserFilesTest, RecentFilesAreFewNewestFirstAndOnce) {
  UserState state;
  for (int i = 0; i < 15; ++i) remember_files(state, {"/data/" + std::to_string(i) + ".ply"});
  remember_files(state, {"/data/x/../9.ply"});
  ASSERT_EQ(state.recent_files.size(), RECENT_COUNT);
  EXPECT_EQ(state.recent_files[0], SceneFiles{"/data/9.ply"});
  EXPECT_EQ(state.recent_files[1], SceneFiles{"/data/14.ply"});
  EXPECT_EQ(std::count(state.recent_files.begin(), state.recent_files.end(), SceneFiles{"/data/9.ply"}), 1);
  remember_files(state, {"here.ply", "folder/"});
  EXPECT_TRUE(state.recent_files[0][0].is_absolute());
  EXPECT_EQ(scene_title(state.recent_files[0]), "here.ply and 1 more");
  EXPECT_EQ(scene_title({"folder/"}), "folder");
  EXPECT_EQ(scene_name({"here.ply"}), scene_name(state.recent_files[0]));
}

Camera camera_at_x(double x) { return {{x, 0, 0}, {0, 0, 0}, {0, 1, 0}, 40.0, 0.0}; }

UserChange bookmark(const std::string& scene, std::size_t slot, double x) {
  return [=](UserState& state) { state.bookmarks[scene][slot] = camera_at_x(x); };
}

TEST(UserFilesTest, TwoWindowsLoseNothingOfEachOther) {
  const TempFolder folder;
  const std::filesystem::path path = folder.path() / "view.json";
  UserMemory one(path), other(path);
  one.change(bookmark("/a", 0, 1.0));
  other.change(bookmark("/a", 1, 2.0));
  one.change([](UserState& state) { remember_files(state, {"/a"}); });
  other.change([](UserState& state) { remember_files(state, {"/b"}); });
  const UserState kept = read_user_state(path);
  EXPECT_EQ(kept.bookmarks.at("/a")[0], camera_at_x(1.0));
  EXPECT_EQ(kept.bookmarks.at("/a")[1], camera_at_x(2.0));
  EXPECT_EQ(kept.recent_files, (std::vector<SceneFiles>{{"/b"}, {"/a"}}));
  EXPECT_EQ(one.state().bookmarks.at("/a")[1], camera_at_x(2.0)) << "each window has the other's";
}

TEST(UserFilesTest, ManyWindowsAtOnceLoseNothing) {
  constexpr std::size_t CHANGES = 6;
  const TempFolder folder;
  const std::filesystem::path path = folder.path() / "view.json";
  std::vector<std::thread> windows;
  for (std::size_t window = 0; window < 3; ++window)
    windows.emplace_back([&path, window] {
      UserMemory memory(path);
      for (std::size_t i = 0; i < CHANGES; ++i)
        memory.change(bookmark("/" + std::to_string(i), window, double(i)));
    });
  for (std::thread& window : windows) window.join();
  const UserState kept = read_user_state(path);
  ASSERT_EQ(kept.bookmarks.size(), CHANGES);
  for (const auto& [scene, bookmarks] : kept.bookmarks)
    for (std::size_t window = 0; window < 3; ++window) EXPECT_TRUE(bookmarks[window]) << scene;
}

TEST(UserFilesTest, WhatCouldNotBeKeptIsKeptWithTheNextChange) {
  const TempFolder folder;
  const std::filesystem::path blocked = folder.write("state", ""), path = blocked / "view.json";
  UserMemory memory(path);
  EXPECT_THROW(memory.change(bookmark("/a", 0, 1.0)), Error);
  EXPECT_TRUE(memory.state().bookmarks.at("/a")[0]) << "this window has it";
  std::filesystem::remove(blocked);
  memory.change(bookmark("/a", 1, 2.0));
  EXPECT_TRUE(read_user_state(path).bookmarks.at("/a")[0]);
  EXPECT_TRUE(read_user_state(path).bookmarks.at("/a")[1]);
}

TEST(UserFilesTest, LinksAndForeignFilesStayAsTheyAre) {
  const TempFolder folder;
  const std::filesystem::path path = folder.path() / "view.json";
  const auto expect_refused = [&](const char* what) {
    try {
      keep(some_state(), path);
      ADD_FAILURE() << what;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::failed);
      EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos) << error.what();
    }
  };
  const std::filesystem::path mine = folder.write("mine.json", R"({"recent_files": []})");
  for (const std::filesystem::path& target : {mine, folder.path() / "none"}) {
    std::filesystem::create_symlink(target, path);
    expect_refused("a link");
    EXPECT_TRUE(std::filesystem::is_symlink(path));
    std::filesystem::remove(path);
  }
  EXPECT_EQ(std::filesystem::file_size(mine), 20U);
  for (const char* foreign : {"my notes", "[1, 2]", R"({"editor": "mine"})"}) {
    folder.write("view.json", foreign);
    expect_refused(foreign);
    EXPECT_EQ(std::filesystem::file_size(path), std::string(foreign).size());
  }
  folder.write("view.json", "");
  keep(some_state(), path);
  std::filesystem::remove(folder.path() / "view.lock");
  std::filesystem::create_symlink(mine, folder.path() / "view.lock");
  EXPECT_THROW(keep(some_state(), path), Error);
}

}  // namespace
}  // namespace splatray
