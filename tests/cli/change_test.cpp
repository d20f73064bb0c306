/// How surfaces have moved between two scenes (app/library/picture/change.h).
#include "app/library/picture/change.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "engine/base/error.h"
#include "engine/scene/splat.h"
#include "preprocess/build.h"
#include "tests/cli/child_process.h"

namespace splatray {
namespace {

/// side x side points 0.02 apart around the z axis, at height(x, y), facing up or down.
template <typename Height>
Scene sheet(int side, const Height& height, float up = 1.0F) {
  constexpr double STEP = 0.02;
  Input input;
  InputObject& object = input.objects.emplace_back();
  object.name = "sheet";
  object.material = default_material();
  for (int i = 0; i < side * side; ++i) {
    const double x = STEP * (i % side - side / 2), y = STEP * (i / side - side / 2);
    const double slope = (height(x + 1e-6, y) - height(x, y)) / 1e-6;
    object.points.position.emplace_back(500000.0 + x, 5000000.0 + y, height(x, y));
    object.points.normal.push_back(up * glm::vec3(glm::normalize(glm::dvec3(-slope, 0.0, 1.0))));
  }
  BuildStats stats;
  return build_scene(std::move(input), {}, 1, stats);
}

struct Compared {
  Scene scene;
  ChangeFound found;
  [[nodiscard]] double change(std::size_t i) const {
    return find_column(scene.columns, COLUMN_CHANGE)->number(i);
  }
  [[nodiscard]] glm::dvec3 place(std::size_t i) const {
    return scene.root.to_world(unpack_center(scene.data_pool[i])) - glm::dvec3(500000.0, 5000000.0, 0.0);
  }
};

Compared compared(Scene scene, const Scene& earlier) {
  const ChangeFound found = add_change(scene, earlier, *open_device(HOST_DEVICE), {});
  return {std::move(scene), found};
}

TEST(Change, OfASheetThatRoseIsItsRise) {
  for (const double rise : {0.0, 0.003, 0.25, -0.25}) {
    const Compared result = compared(sheet(30, [=](double, double) { return 10.0 + rise; }),
                                     sheet(40, [](double, double) { return 10.0; }));
    for (std::size_t i = 0; i < result.scene.data_pool.size(); ++i)
      ASSERT_NEAR(result.change(i), rise, 1e-5) << i;
    EXPECT_EQ(result.found.met, result.scene.data_pool.size());
    EXPECT_NEAR(result.found.median_world, std::abs(rise), 1e-5);
  }
}

TEST(Change, HasTheSideOfTheNormals) {
  const Compared result = compared(sheet(
                                       20, [](double, double) { return 10.1; }, -1.0F),
                                   sheet(40, [](double, double) { return 10.0; }));
  for (std::size_t i = 0; i < result.scene.data_pool.size(); ++i) ASSERT_NEAR(result.change(i), -0.1, 1e-5);
}

TEST(Change, IsAlongTheNormal) {
  const auto slope = [](double rise) { return [=](double x, double) { return 10.0 + 0.75 * x + rise; }; };
  const Compared result = compared(sheet(20, slope(0.05)), sheet(60, slope(0.0)));
  for (std::size_t i = 0; i < result.scene.data_pool.size(); ++i)
    ASSERT_NEAR(result.change(i), 0.05 * 0.8, 1e-5) << "0.8 is the slope's cosine";
}

TEST(Change, OfBentSheetsIsTheNearestSurface) {
  const auto wave = [](double rise) {
    return [=](double x, double) { return 10.0 + 0.02 * std::sin(9.0 * x) + rise; };
  };
  Compared result = compared(sheet(40, wave(0.01)), sheet(60, wave(0.0)));
  double worst = 0.0;
  for (std::size_t i = 0; i < result.scene.data_pool.size(); ++i) {
    const glm::dvec3 place = result.place(i);
    const double cosine = 1.0 / std::hypot(1.0, 0.18 * std::cos(9.0 * place.x));
    worst = std::max(worst, std::abs(result.change(i) - 0.01 * cosine));
  }
  EXPECT_LT(worst, 2e-4) << "discs stand in for the sheet between its points";
}

TEST(Change, IsNoNumberWhereTheOtherIsNot) {
  const Compared result = compared(sheet(60, [](double, double) { return 10.2; }),
                                   sheet(20, [](double, double) { return 10.0; }));
  std::size_t inside = 0;
  for (std::size_t i = 0; i < result.scene.data_pool.size(); ++i) {
    const glm::dvec3 place = glm::abs(result.place(i));
    const double far = std::max(place.x, place.y);
    if (far < 0.17) {
      ++inside;
      ASSERT_NEAR(result.change(i), 0.2, 1e-5);
    } else if (far > 0.25) {
      ASSERT_TRUE(std::isnan(result.change(i)));
    }
  }
  EXPECT_GE(result.found.met, inside);
  EXPECT_LT(result.found.met, result.scene.data_pool.size() / 4);
}

TEST(Change, OfAMeshIsTheDistanceFromItsFaces) {
  const std::string path = ::testing::TempDir() + "floor.obj";
  std::ofstream(path) << "v 499999 4999999 10\nv 500001 4999999 10.5\nv 500001 5000001 10.5\nv 499999 "
                         "5000001 10\nf 1 2 3 4\n";
  BuildStats stats;
  const Scene floor = build_scene(read_input({path}, {}), {}, 0, stats);
  const Compared result =
      compared(sheet(30, [](double x, double) { return 10.25 + 0.25 * x + 0.03; }), floor);
  EXPECT_EQ(result.found.met, result.scene.data_pool.size());
  for (std::size_t i = 0; i < result.scene.data_pool.size(); ++i)
    ASSERT_NEAR(result.change(i), 0.03 / std::hypot(1.0, 0.25), 1e-4) << i;
}

TEST(Change, NoiseOfBothSaysWhatIsSignificant) {
  Scene scene = sheet(30, [](double x, double) { return x > 0.0 ? 10.02 : 10.001; });
  Scene earlier = sheet(40, [](double, double) { return 10.0; });
  scene.stations.resize(1), earlier.stations.resize(1);
  scene.stations[0].noise_world = 0.003, earlier.stations[0].noise_world = 0.004;
  const ChangeFound found = add_change(scene, earlier, *open_device(HOST_DEVICE), {});
  EXPECT_NEAR(found.significant_world, 1.96 * 0.005, 1e-12);
  EXPECT_GT(found.significant, scene.data_pool.size() * 4 / 10);
  EXPECT_LT(found.significant, scene.data_pool.size() * 6 / 10);
  EXPECT_THROW(
      add_change(scene, earlier, *open_device(HOST_DEVICE), [](const char*, double) { return false; }),
      Error);
}

class CliChange : public CliTest {};

TEST_F(CliChange, IsAnAttributeLikeOthers) {
  write("a.ply", grid_ply(true));
  ASSERT_EQ(run_program({PREPROCESS, file("a.ply"), "-o", file("a.soct")}).code, 0);
  for (const char* input : {"a.ply", "a.soct"}) {
    const ChildResult result =
        run_program({PREPROCESS, file(input), "--change-from", file("a.soct"), "-o", file("b.soct")});
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_NE(result.out.find("change: 144 of 144 splats meet the earlier surface"), std::string::npos)
        << result.out;
    EXPECT_NE(run_program({INFO, file("b.soct")}).out.find("change"), std::string::npos);
  }
  expect_refused(
      [&] {
        return run_program(
            {PREPROCESS, file("a.ply"), "--change-from", file("none.ply"), "-o", file("c.soct")});
      },
      3, "none.ply");
}

}  // namespace
}  // namespace splatray
