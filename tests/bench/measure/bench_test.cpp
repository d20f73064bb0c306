// The whole way of a case: prepared, measured, recorded; and a moved splat changes the record.
#include <gtest/gtest.h>

#include <set>

#include "engine/device/vulkan/vulkan_device.h"
#include "engine/file/scene_file.h"
#include "engine/scene/splat.h"
#include "tests/bench/cases/case_file.h"
#include "tests/bench/cases/prepare.h"
#include "tests/bench/measure/measure.h"
#include "tests/readers/read_error.h"

namespace splatray::testing {
namespace {

/// The first of the quick cases made small.
Case small_case() {
  Case one = cases(true).front();
  one.width = one.height = 48;
  one.rays = 2000;
  one.runs.resize(3);
  for (Run& run : one.runs) run.variant.points = 2000;
  return one;
}

class BenchOfACase : public ::testing::Test {
 protected:
  TempFolder temp_;
  Case case_ = small_case();
  VulkanDevice device_;

  void SetUp() override { prepare_case(case_, {"", "", temp_.path()}); }
  [[nodiscard]] std::filesystem::path folder() const { return temp_.path() / folder_name(case_); }
  [[nodiscard]] std::vector<Json> measure() { return measure_case(device_, case_, folder()); }
};

TEST_F(BenchOfACase, RecordsEveryRun) {
  const std::vector<Json> records = measure();
  ASSERT_EQ(records.size(), case_.runs.size());
  for (std::size_t i = 0; i < records.size(); ++i) {
    const Json& record = records[i];
    EXPECT_EQ(record.at("case"), case_.name);
    EXPECT_EQ(record.at("varied"), case_.runs[i].varied);
    EXPECT_EQ(record.at("method"), record.at("settings").at("blend"));
    EXPECT_EQ(record.at("settings").at("splats"), 2000);
    EXPECT_EQ(record.at("device").at("name"), device_.info().name);
    EXPECT_GE(record.at("speed").at("frames").get<std::size_t>(), 9U);
    EXPECT_GE(record.at("speed").at("frame_ms_median"), record.at("speed").at("frame_ms_min"));
    EXPECT_GT(record.at("speed").at("tests_per_ray").get<double>(), 1.0);
    EXPECT_EQ(record.at("error").at("truth"), "analytic");
    EXPECT_LT(record.at("error").at("depth_abs_median").get<double>(), 1e-3);
    EXPECT_LT(record.at("error").at("normal_rms_deg").get<double>(), 5.0);
    EXPECT_EQ(record.at("error").at("holes_ppm").at("rays"), 2000);
  }
  EXPECT_NE(records[0].at("error"), records[2].at("error")) << "no blending makes no difference";
}

TEST_F(BenchOfACase, AMovedSplatChangesTheRecord) {
  case_.runs.resize(1);
  const Json before = measure().front().at("error");
  const std::filesystem::path path = folder() / file_name(case_.runs.front().variant);
  Scene scene = read_scene(path);
  for (uvec4& words : scene.data_pool.edit()) {
    Splat splat = unpack_splat(words);
    const glm::dvec3 to_eye = glm::normalize(read_case(folder()).camera.eye);
    if (glm::dot(splat.normal, to_eye) < 0.99) continue;
    splat.center += 200.0 * glm::round(5.0 * splat.normal);
    words = pack_splat(splat);
  }
  scene.wide_nodes = {};
  write_scene(scene, path);
  const Json after = measure().front().at("error");
  EXPECT_NE(before.at("depth_abs_p99"), after.at("depth_abs_p99"));
  EXPECT_NE(before.at("depth_bias_r"), after.at("depth_bias_r"));
}

TEST_F(BenchOfACase, FillsAsMuchOfThePictureAsItSays) {
  const Truth truth = read_truth(folder() / "truth.bin", case_.width, case_.height);
  std::set<std::size_t> rows;
  for (std::size_t i = 0; i < truth.pixels.size(); ++i)
    if (truth.pixels[i].hit()) rows.insert(i / truth.width);
  EXPECT_NEAR(static_cast<double>(rows.size()), case_.fill * case_.height, 2.0);
}

TEST(Cases, HaveNamesOfTheirOwnAndVaryWhatTheySay) {
  for (const bool quick : {true, false}) {
    std::set<std::string> folders;
    for (const Case& one : cases(quick)) {
      EXPECT_TRUE(folders.insert(folder_name(one)).second) << one.name;
      EXPECT_EQ(one.runs.front().varied, "");
      const Json first = start_record(one, one.runs.front(), 0).at("settings");
      for (std::size_t i = 1; i < one.runs.size(); ++i) {
        const std::string& varied = one.runs[i].varied;
        const Json settings = start_record(one, one.runs[i], 0).at("settings");
        ASSERT_TRUE(settings.contains(varied)) << one.name << ": " << varied;
        EXPECT_TRUE(settings != first || varied == "splats") << one.name << ": " << varied;
      }
    }
  }
}

TEST(CaseFile, ComesBack) {
  const TempFolder temp;
  PreparedCase prepared;
  prepared.camera.eye = {1.0, -2.5, 1e6};
  prepared.camera.fov_y_deg = 12.25;
  prepared.diagonal_world = 3.5;
  prepared.truth = "mesh";
  prepared.variants["a.soct"] = {1.5, 2.25, 0.01};
  write_case(prepared, temp.path());
  const PreparedCase back = read_case(temp.path());
  EXPECT_EQ(back.camera.eye, prepared.camera.eye);
  EXPECT_EQ(back.camera.fov_y_deg, prepared.camera.fov_y_deg);
  EXPECT_EQ(back.truth, "mesh");
  EXPECT_EQ(back.variants.at("a.soct").overlap, 2.25);

  const Environment studio = studio_environment();
  write_environment(studio, temp.path() / "environment.bin");
  EXPECT_EQ(read_environment_file(temp.path() / "environment.bin").texels, studio.texels);
}

}  // namespace
}  // namespace splatray::testing
