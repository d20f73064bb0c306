/// Files of SPLATRAY_DATA_DIR that were made to harm or to mislead: from the file to the scene.
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>

#include "preprocess/build.h"
#include "tests/readers/read_error.h"

namespace splatray {
namespace {

/// What becomes of files, as splatray-preprocess has it.
struct Outcome {
  int exit = 0;
  std::string error;
  std::vector<std::string> notes;
  BuildStats stats;
  Scene scene;

  [[nodiscard]] bool has_note(const std::string& text) const {
    return std::any_of(notes.begin(), notes.end(),
                       [&](const std::string& note) { return note.find(text) != std::string::npos; });
  }
};

class HostileData : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* const data = std::getenv("SPLATRAY_DATA_DIR");
    if (data == nullptr) GTEST_SKIP() << "SPLATRAY_DATA_DIR is not set: no hostile files to read";
    folder_ = std::filesystem::path(data) / "hostile";
    if (!std::filesystem::exists(folder_))
      GTEST_SKIP() << folder_ << " is not there: no hostile files to read";
  }

  [[nodiscard]] Outcome build(const std::vector<std::string>& names) const {
    std::vector<std::filesystem::path> paths;
    for (const std::string& name : names) paths.push_back(folder_ / name);
    Outcome outcome;
    try {
      Input input = read_input(paths, {});
      outcome.notes = input.notes;
      outcome.scene = build_scene(std::move(input), {}, 0, outcome.stats);
      outcome.notes.insert(outcome.notes.end(), outcome.stats.notes.begin(), outcome.stats.notes.end());
    } catch (const Error& error) {
      outcome.exit = static_cast<int>(error.code());
      outcome.error = error.what();
    }
    return outcome;
  }

  std::filesystem::path folder_;
};

TEST_F(HostileData, WildPointsOfGridsAreLeftOut) {
  for (const auto& [name, points] :
       {std::pair("grid_one_wild_x.pcd", 1036U), {"grid_one_wild_y.ptx", 1200U}}) {
    const Outcome outcome = build({name});
    ASSERT_EQ(outcome.exit, 0) << outcome.error;
    EXPECT_EQ(outcome.stats.points_read, points);
    EXPECT_EQ(outcome.stats.dropped_far, 1U) << name;
    EXPECT_TRUE(outcome.has_note("1 point was left out: it lies ")) << name;
    EXPECT_LE(outcome.stats.dropped_isolated + outcome.stats.dropped_mixed, 2U) << name;
    EXPECT_LT(outcome.scene.root.unit_world, 1e-5) << name;
  }
}

TEST_F(HostileData, AStrayAtTheOriginDoesNotSpoilWorldCoordinates) {
  const Outcome outcome = build({"utm_stray_at_origin.xyz"});
  ASSERT_EQ(outcome.exit, 0) << outcome.error;
  EXPECT_EQ(outcome.stats.dropped_far, 1U);
  EXPECT_EQ(outcome.stats.splats, 7000U);
  EXPECT_TRUE(outcome.has_note("5.2e+06 away from all others, which are 5 across"));
}

TEST_F(HostileData, TimesInNanosecondsEnd) {
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(build({"gps_time_in_nanoseconds.las"}).exit, 0);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
}

TEST_F(HostileData, ForgedCountsTakeNoMemory) {
  rusage before{}, after{};
  getrusage(RUSAGE_SELF, &before);
  const Outcome outcome = build({"chunk_of_12_million.laz"});
  getrusage(RUSAGE_SELF, &after);
  EXPECT_EQ(outcome.exit, 0) << outcome.error;
  EXPECT_EQ(outcome.stats.points_read, 10750U) << "as many as its one chunk says that it has";
  EXPECT_TRUE(
      outcome.has_note("found 10750 whole points, expected the 1099511627776 that the header counts"));
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 100L << 10);
}

TEST_F(HostileData, AReadmeAmongTilesIsLeftOut) {
  const Outcome outcome = build({"tiles_with_readme"});
  EXPECT_EQ(outcome.exit, 0) << outcome.error;
  EXPECT_TRUE(outcome.has_note("readme.txt"));
  EXPECT_EQ(outcome.scene.stations.size(), 2U);
}

TEST_F(HostileData, WithheldPointsAreCounted) {
  const Outcome outcome = build({"all_points_withheld.las"});
  EXPECT_EQ(outcome.exit, 3);
  EXPECT_NE(outcome.error.find("100 withheld"), std::string::npos) << outcome.error;
  EXPECT_NE(outcome.error.find("--keep-withheld"), std::string::npos);
}

TEST_F(HostileData, TwoSystemsAreRefused) {
  const Outcome outcome = build({"utm_zone_32.las", "degrees_same_place.las"});
  EXPECT_EQ(outcome.exit, 3);
  EXPECT_NE(outcome.error.find("utm_zone_32.las"), std::string::npos) << outcome.error;
  EXPECT_NE(outcome.error.find("degrees_same_place.las"), std::string::npos) << outcome.error;
}

TEST_F(HostileData, DialectsAreRead) {
  EXPECT_EQ(build({"commas.pcd"}).stats.points_read, 60U);
  EXPECT_EQ(build({"five_floats.pcd.bin"}).stats.points_read, 2000U);
}

}  // namespace
}  // namespace splatray
