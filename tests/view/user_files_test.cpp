#include "app/view/model/user_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

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

UserState some_state() {
  UserState state;
  state.window_width = 1601;
  state.window_height = 902;
  state.recent_files = {"/data/b.ply", "/data/a.ply"};
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
  write_user_state(state, path);
  write_user_state(state, path);  // replaces
  const UserState read = read_user_state(path);
  EXPECT_EQ(read.window_width, 1601);
  EXPECT_EQ(read.window_height, 902);
  EXPECT_EQ(read.recent_files, state.recent_files);
  EXPECT_EQ(read.bookmarks, state.bookmarks);
}

TEST(UserFilesTest, DamageAtAnyByteGivesDefaultsAtWorst) {
  const TempFolder folder;
  const std::filesystem::path path = folder.path() / "view.json";
  write_user_state(some_state(), path);
  std::ifstream file(path);
  const std::string whole((std::istreambuf_iterator<char>(file)), {});
  for (std::size_t length = 0; length < whole.size(); length += 7) {
    folder.write("view.json", whole.substr(0, length));
    const UserState read = read_user_state(path);
    EXPECT_EQ(read.window_width, UserState{}.window_width);
    EXPECT_TRUE(read.recent_files.empty() && read.bookmarks.empty());
  }
}

TEST(UserFilesTest, WrongMembersHaveTheirDefaultsAndSoundOnesStay) {
  const TempFolder folder;
  const std::filesystem::path path = folder.path() / "view.json";
  EXPECT_EQ(read_user_state(path).window_width, 1280);  // missing
  folder.write("view.json", R"({"window_width": 640, "bookmarks": )" + std::string(200000, '[') +
                                std::string(200000, ']') + "}");
  EXPECT_EQ(read_user_state(path).window_width, 1280);
  for (const char* text : {"[]", "7", "null", "{}", "\"\"", "{\"window_width\": \"wide\"}"}) {
    folder.write("view.json", text);
    EXPECT_EQ(read_user_state(path).window_width, 1280) << text;
  }
  folder.write("view.json", R"({"window_width": 1e300, "window_height": -5, "recent_files": 3,
                  "bookmarks": {"/a": [null], "/b": [null,null,null,null,null,null,null,null,
                  {"eye":[1,2,3],"target":[0,0,0],"up":[0,1,0],"fov_y_deg":30,"ortho_height":0}]}})");
  const UserState read = read_user_state(path);
  EXPECT_EQ(read.window_width, 16384);
  EXPECT_EQ(read.window_height, 320);
  EXPECT_TRUE(read.recent_files.empty());
  EXPECT_FALSE(read.bookmarks.contains("/a"));
  EXPECT_EQ(read.bookmarks.at("/b")[8]->eye, glm::dvec3(1, 2, 3));
}

TEST(UserFilesTest, NoFolderIsASentence) {
  const TempFolder folder;
  folder.write("file", "");
  EXPECT_THROW(write_user_state({}, folder.path() / "file" / "view.json"), Error);
}

TEST(UserFilesTest, RecentFilesAreFewNewestFirstAndOnce) {
  UserState state;
  for (int i = 0; i < 15; ++i) remember_file(state, "/data/" + std::to_string(i) + ".ply");
  remember_file(state, "/data/x/../9.ply");
  ASSERT_EQ(state.recent_files.size(), RECENT_COUNT);
  EXPECT_EQ(state.recent_files[0], "/data/9.ply");
  EXPECT_EQ(state.recent_files[1], "/data/14.ply");
  EXPECT_EQ(std::count(state.recent_files.begin(), state.recent_files.end(), "/data/9.ply"), 1);
  remember_file(state, "here.ply");
  EXPECT_TRUE(state.recent_files[0].is_absolute());
}

}  // namespace
}  // namespace splatray
