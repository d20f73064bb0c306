/// Scenes as options ask for them.
#include "app/library/shot/scene_source.h"

#include <gtest/gtest.h>

#include <fstream>

#include "engine/base/error.h"
#include "engine/file/scene_file.h"
#include "engine/scene/splat.h"

namespace splatray {
namespace {

/// The share of splats of a closed mesh about (1/4, 1/4, 1/4) whose normals point away from there.
double outward_share(const std::string& material) {
  const std::string path = ::testing::TempDir() + "inwards.obj";
  std::ofstream(path) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n";
  Request request;
  request.source.inputs = {path};
  request.look.material = material;
  request.source.params.samples = 400;
  const LoadListener listener{[](const char*, double) { return true; }, [](const std::string&) {}};
  const Scene scene = load_scene(request, listener).scene;
  double outward = 0.0;
  for (const uvec4& words : scene.data_pool) {
    const Splat splat = unpack_splat(words);
    const glm::dvec3 center = scene.root.origin_world + splat.center * scene.root.unit_world;
    outward += glm::dot(center - 0.25, splat.normal) > 0.0 ? 1.0 : 0.0;
  }
  return outward / static_cast<double>(scene.data_pool.size());
}

TEST(LoadScene, NobodyNeedsToListen) {
  const std::string path = ::testing::TempDir() + "quiet.obj",
                    scene_path = ::testing::TempDir() + "quiet.soct";
  std::ofstream(path) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 1 1\n";
  Request request;
  request.source.inputs = {path};
  request.source.params.samples = 400;
  const LoadedScene loaded = load_scene(request, {});
  EXPECT_GT(loaded.scene.data_pool.size(), 0U);
  write_scene(loaded.scene, scene_path);
  request.source.inputs = {scene_path};
  EXPECT_EQ(load_scene(request, {}).scene.data_pool, loaded.scene.data_pool);
}

TEST(LoadScene, GlassOfAMeshWoundInwardsIsTurnedOutwards) {
  EXPECT_EQ(outward_share("glass"), 1.0);
  EXPECT_EQ(outward_share("gold"), 0.0);  // all else stays as it was made
  EXPECT_EQ(outward_share(""), 0.0);
}

/// A pyramid whose format has y up and that stands along z on a base of 2 x 2.
std::string standing_along_z() {
  const std::string path = ::testing::TempDir() + "stands.obj";
  std::ofstream file(path);
  file << "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nv 0 0 4\nf 1 4 3 2\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";
  return path;
}

TEST(LoadScene, TheUpThatIsAskedForNeedsNoNote) {
  Request request;
  request.source.inputs = {standing_along_z()};
  request.source.params.samples = 4000;
  std::string notes;
  const LoadListener listener{{}, [&](const std::string& note) { notes += note; }};
  (void)load_scene(request, listener);
  EXPECT_NE(
      notes.find("up is 0,0,1 by the shape of the points, not by their format; --up=X,Y,Z says otherwise"),
      std::string::npos)
      << notes;
  notes.clear();
  request.look.up = glm::dvec3(1.0, 0.0, 0.0);
  EXPECT_EQ(load_scene(request, listener).scene.up, glm::dvec3(1.0, 0.0, 0.0));
  EXPECT_EQ(notes.find("up is"), std::string::npos) << notes;
}

TEST(LoadScene, OneMaterialForSeveralObjectsNamesThem) {
  const std::string path = ::testing::TempDir() + "second.obj";
  std::ofstream(path) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  Request request;
  request.source.inputs = {standing_along_z(), path};
  request.source.params.samples = 400;
  request.look.material = "gold";
  try {
    (void)load_scene(request, {});
    FAIL() << "one material for two objects";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("--object for one of these: 'stands', 'second'"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace splatray
