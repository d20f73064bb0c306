/// What users say of a scan decides: where the scanner moved, that strays stay.
#include <gtest/gtest.h>

#include <random>

#include "engine/scene/splat.h"
#include "preprocess/build.h"
#include "preprocess/scan/sides.h"
#include "tests/scan_sim/scan_cases.h"

namespace splatray::testing {
namespace {

/// A sheet of 40 x 40 points a metre apart in z = 0, each with its time, and some points high above it.
Input sheet(int strays) {
  Points points;
  std::vector<double> times;
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> jitter(-0.2, 0.2);
  for (int i = 0; i < 1600; ++i) {
    points.position.emplace_back(i % 40 + jitter(random), i / 40 + jitter(random), 0.0);
    times.push_back(i);
  }
  for (int i = 0; i < strays; ++i) {
    points.position.emplace_back(20.0 * i, 10.0, 15.0);
    times.push_back(i);
  }
  points.columns.push_back({std::string(COLUMN_TIME), times});
  Input input;
  input.objects.resize(1);
  input.objects[0].points = std::move(points);
  input.up = glm::dvec3(0.0, 0.0, 1.0);
  return input;
}

double mean_normal_z(const Scene& scene) {
  double sum = 0.0;
  for (const uvec4& words : scene.data_pool) sum += unpack_splat(words).normal.z;
  return sum / static_cast<double>(scene.data_pool.size());
}

TEST(GivenTrack, NormalsFaceTheSensorEvenFromBelow) {
  BuildStats without, with;
  EXPECT_GT(mean_normal_z(build_scene(sheet(0), {}, 0, without)), 0.99) << "a sheet faces up";
  Input input = sheet(0);
  input.objects[0].points.track = {{0.0, {0.0, 20.0, -30.0}}, {1600.0, {40.0, 20.0, -30.0}}};
  EXPECT_LT(mean_normal_z(build_scene(std::move(input), {}, 0, with)), -0.99);
  EXPECT_EQ(with.sides_by[static_cast<std::size_t>(SideRung::track)], 1U);
}

TEST(KeptStrays, AreThere) {
  BuildParams params;
  BuildStats dropped, kept;
  const Scene without = build_scene(sheet(3), params, 0, dropped);
  params.keep_strays = true;
  const Scene with = build_scene(sheet(3), params, 0, kept);
  EXPECT_EQ(dropped.dropped_isolated, 3U);
  EXPECT_EQ(kept.dropped_isolated + kept.dropped_mixed, 0U);
  EXPECT_EQ(with.data_pool.size(), without.data_pool.size() + 3);
}

}  // namespace
}  // namespace splatray::testing
