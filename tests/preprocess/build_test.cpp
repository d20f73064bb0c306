/// build_scene as a whole: the same scene whatever the order and the threads, and every bad input counted.
#include "preprocess/build.h"

#include <gtest/gtest.h>
#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <new>
#include <numeric>
#include <string_view>
#include <thread>

#include "engine/base/error.h"
#include "engine/file/scene_file.h"
#include "engine/scene/pool/copies.h"
#include "engine/scene/splat.h"
#include "tests/preprocess/shapes.h"
#include "tests/temp_folder.h"

namespace splatray {
namespace {

constexpr double NAN_VALUE = std::numeric_limits<double>::quiet_NaN();

Scene build(InputObject object, const BuildParams& params = {}, unsigned threads = 0,
            BuildStats* stats_out = nullptr) {
  BuildStats stats;
  Scene scene = build_scene(test::input_of(std::move(object)), params, threads, stats);
  if (stats_out != nullptr) *stats_out = stats;
  return scene;
}

/// The bytes of the scene's file.
std::string file_of(const Scene& scene) {
  const TempFolder folder;
  const std::filesystem::path path = folder.path() / "scene.soct";
  write_scene(scene, path);
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void expect_same(const Scene& a, const Scene& b) { EXPECT_TRUE(file_of(a) == file_of(b)); }

InputObject colored_noise() {
  InputObject object = test::random_sphere(5000, 3);
  object.points.normal.clear();
  for (std::size_t i = 0; i < 200; ++i) object.points.position[i] = object.points.position[i % 40];
  for (std::size_t i = 0; i < 5000; ++i)
    object.points.color.emplace_back(static_cast<float>(i % 97) / 96.0F, 0.5F, 0.1F);
  return object;
}

TEST(Build, SceneDoesNotDependOnOrderOrThreads) {
  for (const Insertion insertion : {Insertion::overlap, Insertion::probe, Insertion::centre}) {
    BuildParams params;
    params.insertion = insertion;
    const InputObject object = colored_noise();
    const Scene scene = build(object, params, 1);
    EXPECT_EQ(scene.field_pool.size(), scene.data_pool.size());
    expect_same(scene, build(object, params, 2));
    expect_same(scene, build(test::shuffled(object, 1), params, 2));
  }
}

/// Three spheres of points at random, closer to each other than their points are.
InputObject colored_layers() {
  InputObject layers = test::random_sphere(5000, 1);
  for (const std::uint64_t seed : {2U, 3U}) {
    const InputObject layer = test::random_sphere(5000, seed);
    const double scale = 1.0 + 0.02 * static_cast<double>(seed);
    for (const glm::dvec3& position : layer.points.position)
      layers.points.position.push_back(scale * position);
    layers.points.normal.insert(layers.points.normal.end(), layer.points.normal.begin(),
                                layer.points.normal.end());
  }
  layers.points.color.assign(layers.points.size(), glm::vec3(0.5F));
  return layers;
}

TEST(Build, LeafSizeSuitsTheDevice) {
  InputObject sphere = test::even_sphere(20000);
  EXPECT_EQ(build(sphere).build.leaf_size, 16U);
  sphere.points.color.assign(20000, glm::vec3(0.5F));
  const Scene colored = build(sphere);
  EXPECT_EQ(colored.build.leaf_size, 24U);
  EXPECT_TRUE(copies_fit(pool_counts(colored)));
  const InputObject object = colored_layers();
  const Scene scene = build(object);
  EXPECT_EQ(scene.build.leaf_size, 8U);
  EXPECT_FALSE(copies_fit(pool_counts(scene)));
  BuildParams params;
  params.leaf_size = 8;
  expect_same(scene, build(object, params));
  params.leaf_size = 16;
  const Scene large = build(object, params);
  EXPECT_EQ(large.build.leaf_size, 16U);
  EXPECT_FALSE(copies_fit(pool_counts(large)));
}

TEST(Build, RefusesLooksThatSceneFilesDoNotHold) {
  const auto refusal = [](auto change) -> std::string {
    Input input = test::input_of(test::even_sphere(100));
    change(input);
    BuildStats stats;
    try {
      (void)build_scene(std::move(input), {}, 0, stats);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::input_unreadable);
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal([](Input&) {}), "");
  EXPECT_EQ(refusal([](Input& i) { i.objects[0].material.phong.mirror = 1e30F; }),
            "the input has material 0 with a mirror out of range, expected 0 to 1");
  EXPECT_EQ(refusal([](Input& i) {
              i.lights = {{LIGHT_POINT, glm::dvec3(0.0), vec3(-1.0F)}};
            }),
            "the input has light 0 with a power out of range, expected finite numbers, 0 or more");
}

TEST(Build, PoolsAreConsistent) {
  BuildStats stats;
  const Scene scene = build(colored_noise(), {}, 0, &stats);
  EXPECT_EQ(scene.begin_end.front(), 0U);
  EXPECT_EQ(scene.begin_end.back(), scene.reference_pool.size());
  EXPECT_EQ(std::adjacent_find(scene.begin_end.begin(), scene.begin_end.end(), std::greater_equal<>()),
            scene.begin_end.end())
      << "filled leaves are not empty";
  EXPECT_EQ(scene.color_pool.size(), scene.data_pool.size());
  EXPECT_EQ(stats.splats, scene.data_pool.size());
  EXPECT_EQ(stats.references, scene.reference_pool.size());
  EXPECT_EQ(stats.filled_leaves + 1, scene.begin_end.size());
  EXPECT_EQ(stats.splats + stats.dropped_duplicates, 5000U);
  EXPECT_GT(stats.growth, 0.0);
  EXPECT_EQ(stats.growth, stats.growth_overlap);
}

TEST(Build, CentrePolicyListsEverySplatOnce) {
  BuildParams params;
  params.insertion = Insertion::centre;
  const Scene centres = build(test::random_sphere(3000, 1), params);
  const Scene overlaps = build(test::random_sphere(3000, 1));
  EXPECT_EQ(overlaps.data_pool, centres.data_pool);
  std::vector<std::uint32_t> once(centres.data_pool.size());
  std::iota(once.begin(), once.end(), 0U);
  std::vector<std::uint32_t> listed(centres.reference_pool.begin(), centres.reference_pool.end());
  std::sort(listed.begin(), listed.end());
  EXPECT_EQ(listed, once);
}

TEST(Build, DiscsKeepTheMarginOfTheRoot) {
  for (const std::size_t count : {std::size_t{1}, std::size_t{2}, std::size_t{7}, std::size_t{2000}}) {
    const Scene scene = build(test::random_sphere(count, count));
    for (const uvec4& words : scene.data_pool) {
      const Splat splat = unpack_splat(words);
      const glm::dvec3 half =
          std::sqrt(splat.radius_squared) * glm::sqrt(glm::max(1.0 - splat.normal * splat.normal, 0.0));
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_GE(splat.center[axis] - half[axis], ROOT_MARGIN);
        EXPECT_LE(splat.center[axis] + half[axis], (1U << LATTICE_BITS) - ROOT_MARGIN);
      }
    }
  }
}

TEST(Build, BadPointsAreDroppedAndCounted) {
  InputObject object = test::even_sphere(1000);
  object.points.position[1].x = NAN_VALUE;
  object.points.position[2].y = std::numeric_limits<double>::infinity();
  object.points.position[3].z = -1e200;
  object.points.normal[10] = glm::vec3(0.0F);
  for (std::size_t i = 100; i < 130; ++i) {
    object.points.position[i] = object.points.position[100];
    object.points.normal[i] = object.points.normal[100];
  }
  BuildStats stats;
  const Scene scene = build(object, {}, 0, &stats);
  EXPECT_EQ(stats.points_read, 1000U);
  EXPECT_EQ(stats.dropped_non_finite, 3U);
  EXPECT_EQ(stats.dropped_duplicates, 22U);
  EXPECT_EQ(stats.normals_estimated, 1U);
  EXPECT_EQ(stats.splats, 975U);
  EXPECT_EQ(scene.data_pool.size(), 975U);
}

TEST(Build, NoUsablePointIsAnError) {
  InputObject object;
  object.points.position.assign(3, glm::dvec3(NAN_VALUE));
  for (const InputObject& bad : {object, InputObject{}}) {
    try {
      (void)build(bad);
      FAIL() << "an input without points was accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::input_unreadable);
    }
  }
}

TEST(Build, TooManyObjectsIsAnError) {
  Input input;
  input.objects.resize(OBJECT_MASK + 2);
  BuildStats stats;
  EXPECT_THROW((void)build_scene(std::move(input), {}, 0, stats), Error);
}

TEST(Build, OnePointAndEqualPointsAreOneDiscOfOneUnit) {
  for (const auto& [copies, keep] : {std::pair(1U, false), std::pair(1000U, false), std::pair(1000U, true)}) {
    InputObject object;
    object.points.position.assign(copies, glm::dvec3(4.0e6, -2.0, 0.5));
    BuildParams params;
    params.keep_strays = keep;
    BuildStats stats;
    const Scene scene = build(object, params, 0, &stats);
    EXPECT_EQ(scene.data_pool.size(), keep ? 8U : 1U) << "copies of points of a scan are none of their own";
    EXPECT_EQ(stats.dropped_duplicates, copies - scene.data_pool.size());
    EXPECT_EQ(stats.radii_isolated, keep ? copies : 1U);
    const Splat splat = unpack_splat(scene.data_pool[0]);
    EXPECT_LT(glm::length(scene.root.to_world(splat.center) - glm::dvec3(4.0e6, -2.0, 0.5)), 1e-5);
    EXPECT_NEAR(std::sqrt(splat.radius_squared) * scene.root.unit_world, 1.0, 2e-3);
    EXPECT_NEAR(splat.normal.y, 1.0, 1e-9);
  }
}

TEST(Build, LonePointBesideOthersIsAHundredthOfTheScene) {
  Input input = test::input_of(test::even_sphere(500));
  InputObject lone;
  lone.points.position.emplace_back(1.0, 1.0, 1.0);
  input.objects.push_back(lone);
  BuildStats stats;
  const Scene scene = build_scene(std::move(input), {}, 0, stats);
  for (const uvec4& words : scene.data_pool) {
    const Splat splat = unpack_splat(words);
    if (splat.object == 0) continue;
    EXPECT_NEAR(std::sqrt(splat.radius_squared) * scene.root.unit_world, 0.01 * scene.diagonal_world(), 1e-4);
  }
  EXPECT_EQ(stats.radii_isolated, 1U);
}

TEST(Build, MillimetresSurviveALargeOffset) {
  const glm::dvec3 offset(5.0e5, 4.0e6, 120.0);
  InputObject object = test::square_lattice(100, 0.001);
  for (glm::dvec3& position : object.points.position) position += offset;
  const Scene scene = build(object);
  EXPECT_EQ(scene.data_pool.size(), 10000U);
  for (const uvec4& words : scene.data_pool) {
    const glm::dvec3 mm = (scene.root.to_world(unpack_splat(words).center) - offset) * 1000.0;
    EXPECT_LT(glm::length(mm - glm::round(mm)), 1e-3);
  }
}

TEST(Build, TinyAndHugeScalesGiveTheSameTree) {
  const Scene scene = build(test::even_sphere(2000));
  for (const double scale : {0x1p-90, 0x1p90}) {
    InputObject object = test::even_sphere(2000);
    for (glm::dvec3& position : object.points.position) position *= scale;
    const Scene scaled = build(object);
    EXPECT_EQ(scaled.node_pool, scene.node_pool);
    EXPECT_EQ(scaled.data_pool, scene.data_pool);
  }
}

TEST(Build, ColoursOfSomeObjectsMakeTheOthersWhite) {
  Input input = test::input_of(test::even_sphere(100));
  input.objects.push_back(test::even_sphere(100, {5.0, 0.0, 0.0}));
  input.objects[1].points.color.assign(100, glm::vec3(0.0F, 1.0F, 0.0F));
  BuildStats stats;
  const Scene scene = build_scene(std::move(input), {}, 0, stats);
  ASSERT_EQ(scene.color_pool.size(), scene.data_pool.size());
  for (std::size_t i = 0; i < scene.data_pool.size(); ++i) {
    const bool green = unpack_splat(scene.data_pool[i]).object == 1;
    EXPECT_EQ(scene.color_pool[i], green ? 0xFF00FF00U : 0xFFFFFFFFU);
  }
  EXPECT_TRUE(build(test::even_sphere(100)).color_pool.empty());
}

TEST(Build, InnerGlassHasTheHigherBit) {
  InputObject inner = test::even_sphere(400);
  for (glm::dvec3& position : inner.points.position) position *= 0.5;
  Input input = test::input_of(inner);
  input.objects.push_back(test::input_of(test::even_sphere(400)).objects[0]);
  for (InputObject& object : input.objects) object.material.flags = MATERIAL_DIELECTRIC;
  BuildStats stats;
  const Scene scene = build_scene(std::move(input), {}, 0, stats);
  EXPECT_EQ(scene.materials[0].mask_bit, 1U);
  EXPECT_EQ(scene.materials[1].mask_bit, 0U);
}

TEST(Build, SceneIsDescribed) {
  Input input = test::input_of(test::even_sphere(4000));
  input.objects[0].material.flags = MATERIAL_DIELECTRIC;
  input.objects.push_back(input.objects[0]);
  input.environment_path = "sky.hdr";
  BuildStats stats;
  const Scene scene = build_scene(std::move(input), {}, 0, stats);
  EXPECT_EQ(scene.object_names, (std::vector<std::string>{"sphere", "sphere"}));
  EXPECT_EQ(scene.materials[0].mask_bit, 0U);
  EXPECT_EQ(scene.materials[1].mask_bit, 1U);
  EXPECT_EQ(scene.environment_path, "sky.hdr");
  EXPECT_EQ(scene.up, glm::dvec3(0.0, 1.0, 0.0));
  EXPECT_NEAR(scene.bounds_max_world.z, 1.0, 1e-3);
  EXPECT_NEAR(scene.surface_area_world, 8.0 * 3.14159265, 1e-6);
  EXPECT_GT(stats.overlap, 1.0);
  EXPECT_LT(stats.overlap, 2.2);
}

TEST(Build, ObjectWithoutNormalsIsTwoSided) {
  InputObject object = test::even_sphere(300);
  EXPECT_EQ(build(object).materials[0].flags & MATERIAL_TWO_SIDED, 0U);
  object.points.normal.clear();
  EXPECT_EQ(build(object).materials[0].flags & MATERIAL_TWO_SIDED, MATERIAL_TWO_SIDED);
}

TEST(Build, PointsAloneAreAScanWhetherTheyHaveNormalsOrNot) {
  InputObject points = test::even_sphere(1000);
  points.oriented = false;
  points.surface_area = 0.0;
  const auto are_scan = [&](const InputObject& object, const auto& add) {
    Input input = test::input_of(object);
    add(input);
    BuildStats stats;
    return !build_scene(std::move(input), {}, 0, stats).stations.empty();
  };
  const auto nothing = [](Input&) {};
  EXPECT_TRUE(are_scan(points, nothing));
  EXPECT_FALSE(are_scan(points, [](Input& input) { input.camera.emplace(); })) << "a scene";
  EXPECT_FALSE(are_scan(points, [](Input& input) { input.lights.emplace_back(); })) << "a scene";
  EXPECT_FALSE(are_scan(points, [](Input& input) {
    input.objects.push_back(test::input_of(test::even_sphere(500)).objects.front());
  })) << "a mesh beside them";
  InputObject discs = points, made = points;
  discs.points.radius.assign(discs.points.size(), 0.1F);
  EXPECT_TRUE(are_scan(discs, nothing)) << "what a camera's program writes as discs";
  made.measured = false;
  EXPECT_FALSE(are_scan(made, nothing));
  points.points.normal.clear();
  EXPECT_TRUE(are_scan(points, nothing));
  EXPECT_TRUE(are_scan(points, [](Input& input) { input.camera.emplace(); })) << "what a camera saw";
  EXPECT_FALSE(are_scan(points, [](Input& input) { input.lights.emplace_back(); })) << "someone has lit them";
}

TEST(Build, ProgressCanStopItInEveryStage) {
  InputObject object = test::even_sphere(1000);
  object.points.normal.clear();
  BuildParams params;
  params.insertion = Insertion::probe;
  for (const std::string stage :
       {"normals", "radii", "packing", "insertion", "probes", "slabs", "empty space"}) {
    BuildStats stats;
    const auto stop_there = [&](const char* name, double share) {
      EXPECT_GE(share, 0.0);
      EXPECT_LE(share, 1.0);
      return name != stage;
    };
    try {
      (void)build_scene(test::input_of(object), params, 0, stats, stop_there);
      ADD_FAILURE() << "not stopped: " << stage;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::interrupted);
    }
  }
}

TEST(Build, PointsADenormalApartAreAtOnePlace) {
  InputObject object;
  object.points.position = {{0.0, 0.0, 0.0}, {1e-320, 0.0, 0.0}};
  BuildStats stats;
  const Scene scene = build_scene(test::input_of(object), {}, 0, stats);
  ASSERT_GT(scene.data_pool.size(), 0U);
  for (const uvec4& words : scene.data_pool) EXPECT_TRUE(std::isfinite(unpack_splat(words).radius_squared));
}

/// Leaves the process `bytes` more of address space: as a control group that is nearly full, but for the kill.
void leave_room(std::uint64_t bytes) {
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const rlim_t limit = pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) + bytes;
  const rlimit limits{limit, limit};
  setrlimit(RLIMIT_AS, &limits);
}

/// Builds the scene of a scan in so much room and ends the process with 0, or as a program that has refused it in a sentence; with 1
/// where memory was asked for that is not there.
[[noreturn]] void build_within(std::uint64_t bytes) {
  mallopt(M_MMAP_THRESHOLD, 1 << 16);  // arrays go back to the system when they are freed
  InputObject object = test::random_sphere(300000, 3);
  object.surface_area = 0.0;
  object.oriented = false;
  object.measured = true;
  object.points.normal.clear();
  Input input = test::input_of(std::move(object));
  BuildStats stats;
  leave_room(bytes);
  try {
    static_cast<void>(build_scene(std::move(input), {}, 1, stats));
    std::_Exit(0);
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    std::_Exit(static_cast<int>(error.code()));
  } catch (const std::bad_alloc&) {
    std::_Exit(1);
  }
}

TEST(Build, RefusesInASentenceWhereAStageWouldTakeMoreThanThereIs) {
  constexpr std::string_view SANITIZER = SPLATRAY_SANITIZE;  // of the library
  if (SANITIZER == "thread") GTEST_SKIP() << "ThreadSanitizer takes address space of its own";
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // a process of its own that has no other threads
  const auto ends_well = [](int status) {
    return WIFEXITED(status) && (WEXITSTATUS(status) == 0 || WEXITSTATUS(status) == 5);
  };
  EXPECT_EXIT(build_within(20U << 20U), ::testing::ExitedWithCode(5),
              "a scene of 300000 points needs .* found");
  if (SANITIZER == "address")
    return;  // gives nothing back that is freed, and its threads take more than that
  EXPECT_EXIT(build_within(59U << 19U), ::testing::ExitedWithCode(5),
              "the stage .* of the build needs .* found");
  for (const std::uint64_t megabytes : {30U, 38U, 60U})
    EXPECT_EXIT(build_within(megabytes << 20U), ends_well, "") << megabytes;
}

}  // namespace
}  // namespace splatray
