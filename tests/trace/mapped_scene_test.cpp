// A scene that the host traces where its file is mapped: the bits of one in memory, little memory, and a refusal where someone makes the
// file shorter or writes over it, whatever is being traced. And copied into huge pages once that is worth it.
#include <gtest/gtest.h>
#include <malloc.h>

#include <cstring>
#include <fstream>
#include <numeric>
#include <random>
#include <thread>

#include "engine/base/error.h"
#include "engine/device/host/host_device.h"
#include "engine/device/host/host_queue.h"
#include "engine/file/scene_file.h"
#include "engine/gpu/device_scene.h"
#include "engine/scene/clip.h"
#include "engine/scene/phong.h"
#include "engine/scene/pool/huge_pages.h"
#include "engine/scene/splat.h"
#include "engine/scene/texture_factors.h"
#include "engine/scene/wide/wide_tree.h"
#include "tests/gpu/shown_tracer.h"
#include "tests/temp_folder.h"
#include "tests/trace/different_bits.h"
#include "tests/trace/scenes.h"

namespace splatray::testing {
namespace {

constexpr std::size_t SPLATS = 300000;

/// Splats in one leaf, with all that may lie beside them. The host needs no octree but where a ray meets hundreds of them.
Scene large_scene() {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  Scene scene;
  scene.build.leaf_size = 1;
  scene.bounds_max_world = glm::dvec3(1U << LATTICE_BITS);
  scene.materials = {test_material(MATERIAL_TWO_SIDED)};
  scene.materials.front().roughness = 0.5F;
  scene.object_names = {"all"};
  scene.node_pool = {NODE_FILLED << NODE_TAG_SHIFT};
  scene.begin_end = {0, SPLATS};
  scene.slab_pool = {SLAB_FULL};
  std::vector<std::uint32_t> references(SPLATS), colors, fields, clips;
  std::iota(references.begin(), references.end(), 0U);
  std::vector<uvec4> splats;
  std::vector<std::uint8_t> roughness;
  std::vector<double> time;
  while (splats.size() < SPLATS) {
    const glm::dvec3 axis = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    const double size = 3000.0 + double(random() % 4000);
    splats.push_back(pack_splat({glm::dvec3(1 << 20) + 7e5 * axis, axis, size * size, 0}));
    colors.push_back(random());
    fields.push_back(pack_lean(0.2 * axis, axis));
    clips.push_back(random() % 4 == 0
                        ? pack_ellipse(splats.back(), glm::normalize(glm::cross(axis, {0.1, 0.2, 0.3})), 3.0)
                        : CLIP_NONE);
    roughness.push_back(static_cast<std::uint8_t>(random()));
    time.push_back(double(splats.size()));
  }
  scene.reference_pool = std::move(references);
  scene.data_pool = std::move(splats);
  scene.color_pool = std::move(colors);
  scene.field_pool = std::move(fields);
  scene.clip_pool = std::move(clips);
  scene.columns = {{"texture-roughness", std::move(roughness)}, {"time", std::move(time)}};
  add_wide_tree(scene);
  return scene;
}

/// A scene with each splat four times and without attributes.
Scene four_times(Scene scene) {
  const auto repeat = [](auto& pool) {
    const auto once = pool;
    for (int i = 1; i < 4; ++i) pool.edit().insert(pool.edit().end(), once.begin(), once.end());
  };
  repeat(scene.data_pool);
  repeat(scene.color_pool);
  repeat(scene.field_pool);
  repeat(scene.clip_pool);
  scene.columns.clear();
  std::vector<std::uint32_t> references(scene.data_pool.size());
  std::iota(references.begin(), references.end(), 0U);
  scene.begin_end = {0, static_cast<std::uint32_t>(references.size())};
  scene.reference_pool = std::move(references);
  add_wide_tree(scene);
  return scene;
}

std::vector<RayQuery> rays_at(std::size_t count) {
  std::mt19937 random(6);
  std::normal_distribution<float> normal;
  std::vector<RayQuery> rays;
  while (rays.size() < count) {
    RayQuery ray{};
    ray.dir = glm::normalize(vec3(normal(random), normal(random), normal(random)));
    ray.origin =
        vec3(1 << 20) - 1.5e6F * ray.dir + 2e5F * vec3(normal(random), normal(random), normal(random));
    ray.from_object = NO_OBJECT;
    rays.push_back(ray);
  }
  return rays;
}

/// An array where rays on the host read it, and where the scene has it.
struct ReadArray {
  const void* read;
  std::span<const std::byte> owned;
};

/// All that is copied into huge pages.
std::vector<ReadArray> walked_arrays(DeviceScene& shown, const Scene& scene) {
  const KernelWork& work = static_cast<HostBindings&>(shown.bindings()).work();
  return {{work.tree.nodes, std::as_bytes(std::span(scene.wide_nodes))},
          {work.tree.splats, std::as_bytes(std::span(scene.data_pool))},
          {work.bound[BIND_DATA_POOL], std::as_bytes(std::span(scene.data_pool))},
          {work.bound[BIND_COLOR_POOL], std::as_bytes(std::span(scene.color_pool))},
          {work.bound[BIND_FIELD_POOL], std::as_bytes(std::span(scene.field_pool))},
          {work.bound[BIND_CLIP_POOL], std::as_bytes(std::span(scene.clip_pool))}};
}

std::size_t anonymous_bytes() {
  std::ifstream status("/proc/self/status");
  std::string word;
  std::size_t kib = 0;
  while (status >> word)
    if (word == "RssAnon:") status >> kib;
  return kib * 1024;
}

class MappedScene : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { large = std::make_unique<Scene>(large_scene()); }
  static void TearDownTestSuite() { large.reset(); }
  void SetUp() override { write_scene(*large, path); }

  [[nodiscard]] std::vector<RayHit> hits_of(Scene scene, const Settings& settings = {}) const {
    ShownTracer tracer(device);
    tracer.upload_and_free(scene);
    return tracer.intersect(rays, settings);
  }

  /// What tracing the scene says after `change` was done to its file, when it was on the device.
  template <class Change>
  [[nodiscard]] std::string refusal_after(const Change& change, const Settings& settings = {}) const {
    Scene scene = read_scene(path);
    ShownTracer tracer(device);
    tracer.upload_and_free(scene);
    change();
    try {
      // The octree has all splats in one leaf.
      const bool octree = settings.blend == BLEND_PAPER;
      (void)tracer.intersect(std::span(rays).first(octree ? 20 : rays.size()), settings);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::input_unreadable);
      EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos);
      return error.what();
    }
    return "";
  }

  static std::unique_ptr<Scene> large;
  const HostDevice device;
  const TempFolder folder;
  const std::filesystem::path path = folder.path() / "large.soct";
  const std::vector<RayQuery> rays = rays_at(2000);
};
std::unique_ptr<Scene> MappedScene::large;

TEST_F(MappedScene, HasTheBitsOfOneInMemory) {
  const std::vector<RayHit> expected = hits_of(*large), found = hits_of(read_scene(path));
  EXPECT_EQ(different_bits(found, expected), 0U);
  EXPECT_GT(std::count_if(found.begin(), found.end(), [](const RayHit& hit) { return hit.object == 0; }),
            1000);
  View view;
  view.width = view.height = 48;
  view.camera = {{-3e6, 1e6, 1e6}, {1e6, 1e6, 1e6}, {0.0, 0.0, 1.0}, 30.0, 0.0};
  Settings settings;
  settings.look = LOOK_LIT;
  settings.samples = 2;
  const auto picture = [&](Scene scene) {
    ShownTracer tracer(device);
    tracer.upload_and_free(scene);
    return tracer.render(view, settings).rgba;
  };
  EXPECT_TRUE(picture(*large) == picture(read_scene(path)));
}

TEST_F(MappedScene, TakesLittleMemory) {
  write_scene(four_times(*large), path);
  malloc_trim(0);
  const std::size_t before = anonymous_bytes();
  Scene scene = read_scene(path);
  ShownTracer tracer(device, {.threads = 1});
  tracer.upload_and_free(scene);
  (void)tracer.intersect(rays, {});
  EXPECT_LT(anonymous_bytes() - before, std::filesystem::file_size(path) / 4);
}

TEST_F(MappedScene, ThatShrinksIsRefused) {
  for (const double share : {0.0, 0.3, 0.999}) {
    SCOPED_TRACE(share);
    SetUp();
    const auto length = static_cast<std::uintmax_t>(share * double(std::filesystem::file_size(path)));
    const std::string refusal = refusal_after([&] { std::filesystem::resize_file(path, length); });
    EXPECT_NE(refusal.find("shrank"), std::string::npos) << refusal;
  }
}

// Pages are asked for by all threads at once, while the file goes away.
TEST_F(MappedScene, ThatShrinksAsItIsTracedIsRefused) {
  Scene scene = read_scene(path);
  ShownTracer tracer(device, {.threads = 4});
  tracer.upload_and_free(scene);
  const std::vector<RayQuery> more = rays_at(20000);
  std::jthread shrinks([&] {
    for (std::uintmax_t size = std::filesystem::file_size(path); size > 0; size /= 2)
      std::filesystem::resize_file(path, size);
    std::filesystem::resize_file(path, 0);
  });
  const auto trace_on = [&] {
    while (std::filesystem::file_size(path) > 0) (void)tracer.intersect(more, {});
    (void)tracer.intersect(more, {});
  };
  EXPECT_THROW(trace_on(), Error);
}

TEST_F(MappedScene, ThatShrinksBeforeItIsUploadedIsRefused) {
  Scene scene = read_scene(path);
  std::filesystem::resize_file(path, 5000);
  ShownTracer tracer(device);
  EXPECT_THROW(tracer.upload_and_free(scene), Error);
  EXPECT_THROW((void)tracer.intersect(rays, {}), Error);
}

TEST_F(MappedScene, ThatShrinksIsNotWritten) {
  const Scene scene = read_scene(path);
  std::filesystem::resize_file(path, 5000);
  EXPECT_THROW(write_scene(scene, folder.path() / "copy.soct"), Error);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "copy.soct"));
}

// Whatever is there in place of its splats, references, slabs and boxes: no ray leaves its arrays.
TEST_F(MappedScene, ThatIsWrittenOverIsRefused) {
  for (const std::uint32_t blend : {BLEND_WINDOW, BLEND_PAPER}) {
    SetUp();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));  // times of files have steps
    Settings settings;
    settings.blend = blend;
    const auto write_over = [&] {
      std::mt19937 random(blend);
      std::vector<std::uint32_t> words(std::filesystem::file_size(path) / sizeof(std::uint32_t));
      for (std::uint32_t& word : words) word = random();
      std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
      file.write(reinterpret_cast<const char*>(words.data()),
                 static_cast<std::streamsize>(words.size() * sizeof(std::uint32_t)));
    };
    EXPECT_NE(refusal_after(write_over, settings).find("was changed"), std::string::npos);
  }
}

// What replaces a file by another of its name leaves the one that is traced.
TEST_F(MappedScene, MayBeReplaced) {
  const std::vector<RayHit> expected = hits_of(*large);
  Scene scene = read_scene(path);
  ShownTracer tracer(device);
  tracer.upload_and_free(scene);
  write_scene(*large, path);
  EXPECT_EQ(different_bits(tracer.intersect(rays, {}), expected), 0U);
}

// Boxes without end lead rays to each child, also to those that are not there.
TEST_F(MappedScene, BoxesThatAreWrongLeadNowhereElse) {
  Scene scene = *large;
  const std::vector<RayQuery> few(rays.begin(), rays.begin() + 20);
  const auto hits = [&] {
    ShownTracer tracer(device);
    tracer.upload(scene);
    return tracer.intersect(few, {});
  };
  const std::vector<RayHit> expected = hits();
  for (WideNode& node : scene.wide_nodes.edit())
    for (auto& [low, high] : node.bounds) low.fill(-1e30F), high.fill(1e30F);
  EXPECT_EQ(different_bits(hits(), expected), 0U);
  for (WideNode& node : scene.wide_nodes.edit())
    for (auto& [low, high] : node.bounds) low.fill(std::nanf("")), high.fill(0.0F);
  (void)hits();
}

TEST_F(MappedScene, IsCopiedIntoHugePagesOnceRaysPayForIt) {
  const std::unique_ptr<Queue> queue = device.make_queue();
  const Scene scene = read_scene(path);
  DeviceScene shown(device, *queue, {});
  shown.upload(scene);
  shown.show(look_of(scene));
  shown.bind();
  const auto expect_mapped = [&] {
    for (const auto& [read, owned] : walked_arrays(shown, scene)) EXPECT_EQ(read, owned.data());
  };
  expect_mapped();
  shown.expect_rays(20000);
  expect_mapped();
  shown.expect_rays(SPLATS);
  for (int i = 0; i < 2; ++i) {
    for (const auto& [read, owned] : walked_arrays(shown, scene)) {
      EXPECT_EQ(reinterpret_cast<std::uintptr_t>(read) % HUGE_PAGE_BYTES, 0U);
      EXPECT_NE(read, owned.data());
      EXPECT_EQ(std::memcmp(read, owned.data(), owned.size()), 0);
    }
    shown.bind();
    shown.expect_rays(SPLATS);
  }
}

TEST_F(MappedScene, HasTheSameBitsAndRefusalsInHugePages) {
  const std::vector<RayHit> expected = hits_of(*large);
  std::vector<RayQuery> many = rays;
  RayQuery past_all = rays.front();
  past_all.dir = -past_all.dir;
  many.resize(SPLATS, past_all);
  Scene scene = read_scene(path);
  ShownTracer tracer(device);
  tracer.upload_and_free(scene);
  const std::size_t before = anonymous_bytes();
  std::vector<RayHit> found = tracer.intersect(many, {});
  EXPECT_GT(anonymous_bytes() - before, SPLATS * sizeof(uvec4));
  for (int i = 0; i < 2; ++i, found = tracer.intersect(rays, {})) {
    found.resize(rays.size());
    EXPECT_EQ(different_bits(found, expected), 0U);
  }
  std::filesystem::resize_file(path, 5000);
  EXPECT_THROW((void)tracer.intersect(rays, {}), Error);
}

// Neither what a small picture of a large scene would wait for nor what others may need the memory for.
TEST(HugePages, AreForRaysAndMemoryEnough) {
  constexpr std::uint64_t MIB = std::uint64_t{1} << 20U, GIB = MIB << 10U;
  EXPECT_TRUE(worth_huge_pages(28 * MIB, 1000000, 8 * GIB));
  EXPECT_FALSE(worth_huge_pages(28 * MIB, 64 * 64, 8 * GIB));
  EXPECT_FALSE(worth_huge_pages(560 * MIB, 640 * 400 * 4, 64 * GIB));
  EXPECT_TRUE(worth_huge_pages(560 * MIB, 1920 * 1080 * 64, 64 * GIB));
  EXPECT_FALSE(worth_huge_pages(560 * MIB, 1920 * 1080 * 64, 4 * GIB));
  EXPECT_FALSE(worth_huge_pages(MIB, 1920 * 1080 * 64, 8 * GIB)) << "a few pages";
}

// The tree that a file without one gets is the one that files have.
TEST_F(MappedScene, FilesWithoutATreeAreTracedAlike) {
  Scene scene = *large;
  scene.wide_nodes = {};
  write_scene(scene, path);
  EXPECT_FALSE(has_wide_tree(read_scene(path)));
  EXPECT_EQ(different_bits(hits_of(read_scene(path)), hits_of(*large)), 0U);
}

}  // namespace
}  // namespace splatray::testing
