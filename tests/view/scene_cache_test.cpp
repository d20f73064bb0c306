// Scenes that are kept: found again while nothing they depend on has changed, rebuilt where damaged, bounded.
#include "app/view/thread/scene_cache.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>

#include "app/library/request/command_line.h"
#include "app/library/shot/scene_source.h"
#include "app/view/model/document_request.h"
#include "engine/base/error.h"
#include "tests/temp_folder.h"

namespace splatray {
namespace {

namespace fs = std::filesystem;

class SceneCacheTest : public ::testing::Test {
 protected:
  void SetUp() override {
    request.source.inputs = {write("scan.xyz", 20)};
    loaded = load_scene(request, {});
  }

  fs::path write(const std::string& name, int side) {
    std::ofstream file(folder.path() / name);
    for (int i = 0; i < side * side; ++i) file << i % side << " " << i / side << " 0\n";
    return folder.path() / name;
  }
  [[nodiscard]] bool is_kept(const Request& asked) { return cache.find(asked, {}).has_value(); }
  [[nodiscard]] std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(kept), fs::directory_iterator()));
  }

  TempFolder folder;
  fs::path kept = folder.path() / "new" / "scenes";
  SceneCache cache{kept};
  Request request;
  LoadedScene loaded;
};

TEST_F(SceneCacheTest, GivesBackTheSceneThatWasKept) {
  EXPECT_FALSE(is_kept(request));
  request.source.params.keep_strays = true;
  cache.keep(request, loaded.scene, {});
  const std::optional<Scene> found = cache.find(request, {});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->data_pool, loaded.scene.data_pool);
  EXPECT_EQ(found->node_pool, loaded.scene.node_pool);
  EXPECT_EQ(found->build.leaf_size, loaded.scene.build.leaf_size);
  EXPECT_TRUE(found->build.keep_strays) << "which scene files do not hold";
  EXPECT_EQ(command_line(request_of(first_document(*found, facts_of(*found), request), 64, 48)),
            command_line(request_of(first_document(loaded.scene, loaded.facts, request), 64, 48)))
      << "it is shown alike";
}

TEST_F(SceneCacheTest, IsOfTheFilesAsTheyAreAndOfTheOptions) {
  cache.keep(request, loaded.scene, {});
  Request other = request;
  other.source.params.radius_scale = 2.0;
  EXPECT_FALSE(is_kept(other));
  other = request;
  other.look.up = glm::dvec3(1.0, 0.0, 0.0);
  EXPECT_FALSE(is_kept(other));
  other = request;
  other.source.inputs.push_back(write("more.xyz", 3));
  EXPECT_FALSE(is_kept(other));
  other = request;
  other.source.threads = 1;
  other.settings.samples = 99;
  other.look.attributes.color_by = "height";
  EXPECT_TRUE(is_kept(other)) << "this does not change the scene";
  const auto time = fs::last_write_time(request.source.inputs[0]);
  fs::last_write_time(request.source.inputs[0], time + std::chrono::seconds(1));
  EXPECT_FALSE(is_kept(request));
  fs::last_write_time(request.source.inputs[0], time);
  EXPECT_TRUE(is_kept(request));
  write("scan.xyz", 21);
  fs::last_write_time(request.source.inputs[0], time);
  EXPECT_FALSE(is_kept(request)) << "another size";
}

TEST_F(SceneCacheTest, AFolderIsWhatIsInIt) {
  fs::create_directory(folder.path() / "scans");
  write("scans/a.xyz", 5);
  request.source.inputs = {folder.path() / "scans"};
  cache.keep(request, loaded.scene, {});
  EXPECT_TRUE(is_kept(request));
  write("scans/b.xyz", 5);
  EXPECT_FALSE(is_kept(request));
}

TEST_F(SceneCacheTest, WhatNamesOtherFilesIsNotKept) {
  for (const char* name : {"a.gltf", "a.glb", "a.pvtp", "a.pvtu", "a.soct"}) {
    request.source.inputs = {write(name, 2)};
    EXPECT_TRUE(cache.place_of(request).empty()) << name;
  }
}

TEST_F(SceneCacheTest, ADamagedSceneGoes) {
  cache.keep(request, loaded.scene, {});
  const fs::path place = cache.place_of(request);
  for (const char* damage : {"cut", "changed", "empty"}) {
    cache.keep(request, loaded.scene, {});
    ASSERT_TRUE(is_kept(request));
    const auto size = fs::file_size(place);
    if (*damage == 'c' && damage[1] == 'h') {
      std::fstream file(place, std::ios::in | std::ios::out | std::ios::binary);
      file.seekp(static_cast<std::streamoff>(size / 2));
      file << "damage";
    } else {
      fs::resize_file(place, *damage == 'e' ? 0 : size - 1);
    }
    EXPECT_FALSE(is_kept(request)) << damage;
    EXPECT_FALSE(fs::exists(place)) << damage;
  }
}

TEST_F(SceneCacheTest, TheLongestUnusedGoesFirst) {
  cache.keep(request, loaded.scene, {});
  const std::uint64_t one = cache.bytes();
  cache.clear();
  cache = SceneCache(kept, 2 * one + one / 2);
  std::vector<Request> asked;
  const auto now = fs::file_time_type::clock::now();
  for (int i = 0; i < 3; ++i) {
    asked.push_back(request);
    asked.back().source.params.radius_scale = i + 2.0;
    cache.keep(asked.back(), loaded.scene, {});
    fs::last_write_time(cache.place_of(asked.back()), now - std::chrono::hours(10 - i));
    if (i == 1) {
      EXPECT_TRUE(is_kept(asked[0])) << "and is the newest now";
    }
  }
  EXPECT_TRUE(is_kept(asked[0]) && is_kept(asked[2]));
  EXPECT_FALSE(is_kept(asked[1]));
  EXPECT_LE(cache.bytes(), 2 * one + one / 2);
  cache.clear();
  EXPECT_EQ(cache.bytes(), 0U);
  EXPECT_EQ(files(), 0U);
}

TEST_F(SceneCacheTest, WhatCannotBeKeptLeavesNothing) {
  cache.keep(request, loaded.scene, [](const char*, double) { return false; });
  EXPECT_EQ(files(), 0U) << "stopped";
  std::ofstream(folder.path() / "file") << "no folder";
  for (const fs::path& nowhere : {fs::path(), folder.path() / "file" / "scenes"}) {
    cache = SceneCache(nowhere);
    cache.keep(request, loaded.scene, {});
    EXPECT_FALSE(is_kept(request));
    EXPECT_EQ(cache.bytes(), 0U);
    cache.clear();
  }
}

}  // namespace
}  // namespace splatray
