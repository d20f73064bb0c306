// Volumes against closed forms, and their intervals against what noise does to them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <numbers>
#include <random>

#include "app/library/cut/volume.h"
#include "app/library/measure/measure_file.h"
#include "app/library/measure/measure_text.h"
#include "app/library/picture/volume_measure.h"
#include "app/library/request/value_text.h"
#include "engine/base/error.h"
#include "preprocess/build.h"
#include "tests/all_tests.h"

namespace splatray {
namespace {

using HeightAt = std::function<double(const glm::dvec2&)>;

constexpr double HALF = 2.0;  ///< of the ground's side
const glm::dvec3 ORIGIN(500000.0, 4000000.0, 100.0);

/// How a ground is scanned.
struct Sampling {
  double spacing = 0.03;
  double noise = 0.0;
  unsigned seed = 1;
  std::function<bool(const glm::dvec2&)> is_seen = [](const glm::dvec2&) { return true; };
};

/// Places as dense on slopes as on level ground, as a scanner has them that sees all alike.
std::vector<glm::dvec3> sampled(const HeightAt& height, const Sampling& sampling) {
  constexpr double STEEPEST = 12.0, STEP = 1e-4;
  std::mt19937 random(sampling.seed);
  std::uniform_real_distribution<double> along(-HALF, HALF), part(0.0, 1.0);
  std::normal_distribution<double> noise(0.0, 1.0);
  const double count = STEEPEST * 4.0 * HALF * HALF / (sampling.spacing * sampling.spacing);
  std::vector<glm::dvec3> places;
  for (double i = 0.0; i < count; ++i) {
    const glm::dvec2 at(along(random), along(random));
    const double z = height(at);
    const glm::dvec2 slope((height(at + glm::dvec2(STEP, 0.0)) - z) / STEP,
                           (height(at + glm::dvec2(0.0, STEP)) - z) / STEP);
    const double stretch = std::sqrt(1.0 + glm::dot(slope, slope));
    if (part(random) * STEEPEST > stretch || !sampling.is_seen(at)) continue;
    places.push_back(ORIGIN + glm::dvec3(at, z) +
                     sampling.noise * noise(random) * glm::dvec3(-slope, 1.0) / stretch);
  }
  return places;
}

Scene ground(const HeightAt& height, const Sampling& sampling) {
  Input input;
  input.objects.emplace_back().points.position = sampled(height, sampling);
  BuildStats stats;
  Scene scene = build_scene(std::move(input), {}, 0, stats);
  scene.up = {0.0, 0.0, 1.0};
  return scene;
}

std::vector<SurfacePoint> square(double half) {
  std::vector<SurfacePoint> corners;
  for (const glm::dvec2& at : {glm::dvec2(-half, -half), {half, -half}, {half, half}, {-half, half}})
    corners.push_back({ORIGIN + glm::dvec3(at, 0.0)});
  return corners;
}

VolumeFound measured(const Scene& scene, const std::string& base, std::vector<SurfacePoint> outline) {
  Measure measure{MeasureKind::volume, std::move(outline)};
  take_volume(scene, {}, read_base(base), measure);
  return *measure.volume;
}

double cone(const glm::dvec2& at) { return std::max(0.8 * (1.0 - glm::length(at)), 0.0); }
double hemisphere(const glm::dvec2& at) { return std::sqrt(std::max(1.0 - glm::dot(at, at), 0.0)); }
double wedge(const glm::dvec2& at) { return 0.3 * at.x; }
constexpr double CONE = 0.8 * std::numbers::pi / 3.0, BALL = 2.0 * std::numbers::pi / 3.0;

TEST(CellParts, AddUpToTheOutline) {
  const std::vector<glm::dvec2> arrow = {{0.1, 0.2}, {2.7, 0.4}, {1.9, 1.1}, {2.2, 2.9}, {1.2, 1.3}};
  double wanted = 0.0;
  for (std::size_t i = 0; i < arrow.size(); ++i) {
    const glm::dvec2 &a = arrow[i], &b = arrow[(i + 1) % arrow.size()];
    wanted += 0.5 * (a.x * b.y - a.y * b.x);
  }
  double sum = 0.0;
  for (const CellPart& part : cell_parts({0.0, 3.0}, 0.25, 12, 12, arrow)) {
    EXPECT_TRUE(part.area >= 0.0 && part.area <= 0.0625 + 1e-12) << part.area;
    sum += part.area;
  }
  EXPECT_NEAR(sum, std::abs(wanted), 1e-9);
  const std::vector<glm::dvec2> half = {{0, 0}, {1, 0}, {1, 1}};
  const CellPart part = cell_parts({0.0, 1.0}, 1.0, 1, 1, half).at(0);
  EXPECT_DOUBLE_EQ(part.area, 0.5);
  EXPECT_NEAR(glm::distance(part.middle, {2.0 / 3.0, 1.0 / 3.0}), 0.0, 1e-12);
}

TEST(Volume, IsThatOfClosedForms) {
  struct Case {
    const char* name;
    HeightAt height;
    std::string base;
    double half, cut, fill;
    double widest = 0.005;  ///< of net, part of both; steep rims are known least
  };
  const std::vector<Case> cases = {
      {"cone", cone, "z=100", 1.5, CONE, 0.0},
      {"half a ball", hemisphere, "z=100", 1.5, BALL, 0.0, 0.03},
      {"wedge", wedge, "z=100", 1.5, 0.5 * 0.3 * 1.5 * 1.5 * 3.0, 0.5 * 0.3 * 1.5 * 1.5 * 3.0},
      {"slope over a level below", wedge, "z=99", 1.5, 9.0, 0.0},
      {"slope over a parallel plane", wedge, "plane=500000,4000000,100.5,-0.3,0,1", 1.5, 0.0, 4.5},
      {"cone over the plane through its foot", cone, "corners", 1.5, CONE, 0.0},
  };
  for (const Case& one : cases) {
    const Scene scene = ground(one.height, {});
    const VolumeFound found = measured(scene, one.base, square(one.half));
    EXPECT_NEAR(found.cut, one.cut, found.cut_within) << one.name;
    EXPECT_NEAR(found.fill, one.fill, found.fill_within) << one.name;
    EXPECT_NEAR(found.net(), one.cut - one.fill, found.net_within) << one.name;
    EXPECT_LT(found.net_within, one.widest * (one.cut + one.fill)) << one.name;
    EXPECT_NEAR(found.area, 9.0, 0.02) << one.name;
    EXPECT_NEAR(found.area + found.uncovered, 9.0, 1e-6) << one.name;
  }
}

TEST(Volume, HasIntervalsThatHoldTheTruth) {
  const HeightAt slope = [](const glm::dvec2& at) { return 0.1 * at.x - 0.05 * at.y; };
  const double cut_truth = [&] {
    double sum = 0.0;
    constexpr int CELLS = 600;
    for (int i = 0; i < CELLS; ++i)
      for (int j = 0; j < CELLS; ++j)
        sum += std::max(slope(3.0 * glm::dvec2(i + 0.5, j + 0.5) / double(CELLS) - 1.5), 0.0);
    return sum * 9.0 / (CELLS * CELLS);
  }();
  const unsigned seeds = testing::all_or(200U, 15U);
  unsigned net = 0, cut = 0, corners = 0;
  double squares = 0.0, within = 0.0;
  for (unsigned seed = 0; seed < seeds; ++seed) {
    const Scene scene = ground(slope, {.spacing = 0.06, .noise = 0.01, .seed = seed + 1});
    const VolumeFound level = measured(scene, "z=100", square(1.5));
    net += std::abs(level.net()) <= level.net_within ? 1U : 0U;
    cut += std::abs(level.cut - cut_truth) <= level.cut_within ? 1U : 0U;
    squares += level.net() * level.net() / seeds;
    within += level.net_within / seeds;
    const VolumeFound plane = measured(scene, "plane=500000,4000000,100,-0.1,0.05,1", square(1.5));
    corners += std::abs(plane.cut) <= plane.cut_within && std::abs(plane.fill) <= plane.fill_within ? 1U : 0U;
  }
  std::printf("net held %u, cut %u, of one surface %u of %u; interval %.2g, deviation %.2g\n", net, cut,
              corners, seeds, within, std::sqrt(squares));
  EXPECT_GE(net, 0.9 * seeds);
  EXPECT_GE(cut, 0.9 * seeds);
  EXPECT_GE(corners, 0.9 * seeds);
  EXPECT_LT(within, 3.0 * 1.96 * std::sqrt(squares)) << "wider than need be";
}

TEST(Volume, HasHolesBetweenWhatIsAndNothingBeyond) {
  const auto hole = [](const glm::dvec2& at) { return glm::distance(at, {0.4, 0.3}) > 0.25; };
  const VolumeFound whole = measured(ground(cone, {}), "z=100", square(1.5));
  const VolumeFound holed = measured(ground(cone, {.is_seen = hole}), "z=100", square(1.5));
  EXPECT_NEAR(holed.cut, CONE, holed.cut_within);
  EXPECT_GT(holed.cut_within, 3.0 * whole.cut_within) << "less is known";
  EXPECT_LT(holed.uncovered, 0.01) << "a hole is covered by what is around";
  const auto half = [](const glm::dvec2& at) { return at.x < 0.0; };
  const VolumeFound cut_off = measured(ground(cone, {.is_seen = half}), "z=100", square(1.5));
  EXPECT_NEAR(cut_off.uncovered, 4.5, 0.15);
  EXPECT_NEAR(cut_off.cut, 0.5 * CONE, 0.03);
}

TEST(Volume, IsOfAllWithoutAnOutlineAndAgainstAnEarlierScan) {
  Measure all{MeasureKind::volume, {}};
  const Scene scene = ground(cone, {});
  take_volume(scene, {}, read_base("z=100"), all);
  EXPECT_NEAR(all.volume->cut, CONE, all.volume->cut_within);
  EXPECT_EQ(all.points.size(), 4U) << "the rectangle that was measured";
  const Scene before = ground([](const glm::dvec2& at) { return 0.2 * cone(at); }, {.seed = 5});
  const VolumeGround later{scene, {}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 0.0}, {}};
  const std::optional<VolumeFound> found = volume_over(later, {.earlier = &before});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->net(), 0.8 * CONE, found->net_within);
}

TEST(Volume, OfAllHoldsThatItsBorderIsKnownToADisc) {
  const double side = 2.0;
  for (const double turn : {0.0, 0.5}) {
    const glm::dvec2 along(std::cos(turn), std::sin(turn)), across(-along.y, along.x);
    const auto inside = [&](const glm::dvec2& at) {
      return std::max(std::abs(glm::dot(at, along)), std::abs(glm::dot(at, across))) < 0.5 * side;
    };
    const Scene scene = ground([](const glm::dvec2&) { return 3.0; }, {.noise = 0.002, .is_seen = inside});
    for (const bool is_all : {true, false}) {
      Measure measure{MeasureKind::volume, is_all ? std::vector<SurfacePoint>{} : square(1.5)};
      take_volume(scene, {}, read_base("z=100"), measure);
      const double truth = 3.0 * side * side;
      EXPECT_NEAR(measure.volume->cut, truth, measure.volume->cut_within) << turn << ' ' << is_all;
      EXPECT_NEAR(measure.volume->net(), truth, measure.volume->net_within) << turn << ' ' << is_all;
      EXPECT_LT(measure.volume->net_within, 0.1 * truth) << turn << ' ' << is_all;
    }
  }
}

TEST(Volume, InFeetIsTheSameInFeet) {
  Input input;
  std::vector<glm::dvec3>& feet = input.objects.emplace_back().points.position;
  for (const glm::dvec3& place : sampled(cone, {})) feet.push_back(place / 0.3048);
  BuildStats stats;
  Scene scene = build_scene(std::move(input), {}, 0, stats);
  scene.up = {0.0, 0.0, 1.0};
  std::vector<SurfacePoint> outline = square(1.5);
  for (SurfacePoint& corner : outline) corner.place /= 0.3048;
  const VolumeFound found = measured(scene, "z=" + std::to_string(100.0 / 0.3048), outline);
  EXPECT_NEAR(found.cut * std::pow(0.3048, 3), CONE, 0.01 * CONE);
}

TEST(Volume, IsWrittenAndReadAlike) {
  Measure measure{MeasureKind::volume, square(1.0)};
  measure.name = "heap";
  measure.volume = VolumeFound{12.3456, 0.5, 0.12, 0.1, 0.2, 9.0, 0.25};
  const MeasureFrame frame{{0.0, 0.0, 1.0}, {}, 1.0};
  const std::string table = csv_text({&measure, 1}, frame);
  EXPECT_NE(table.find("1,heap,volume,cut,12.35,0.12,m\u00B3"), std::string::npos) << table;
  EXPECT_NE(table.find("1,heap,volume,net,11.85,0.20,m\u00B3"), std::string::npos) << table;
  EXPECT_NE(table.find("1,heap,volume,uncovered,0.25,,m\u00B2"), std::string::npos) << table;
  const std::filesystem::path path = std::filesystem::path(::testing::TempDir()) / "volume_test.geojson";
  write_measures({&measure, 1}, frame, path);
  EXPECT_EQ(read_measures(path, ""), std::vector<Measure>{measure});
  EXPECT_NE(dxf_text({&measure, 1}, frame).find("heap: cut 12.35"), std::string::npos);
}

TEST(Volume, OfWrongBasesAndOutlinesIsRefused) {
  for (const char* text : {"", "z=", "0,0,0;1,0,0;z=1", "0,0,0;corners", "plane=0,0,0", "plane=0,0,0,0,0,0",
                           "earlier=", "0,0,0;1,0,0;1,1,0", "base=1"})
    EXPECT_THROW((void)read_measure(MeasureKind::volume, text), Expected) << text;
  EXPECT_EQ(read_measure(MeasureKind::volume, "z=1").places.size(), 0U);
  EXPECT_EQ(read_measure(MeasureKind::volume, "0,0,0;1,0,0;1,1,0;earlier=a b.soct").base->earlier,
            "a b.soct");
  const Scene scene = ground(wedge, {.spacing = 0.1});
  Measure upright{MeasureKind::volume, square(1.0)};
  EXPECT_THROW(take_volume(scene, {}, read_base("plane=0,0,0,1,0,0"), upright), Error);
  Measure crossed{MeasureKind::volume, square(1.0)};
  std::swap(crossed.points[2], crossed.points[3]);
  EXPECT_THROW(take_volume(scene, {}, read_base("z=99"), crossed), Error) << "it has no inside";
  Measure elsewhere{MeasureKind::volume, square(1.0)};
  for (SurfacePoint& corner : elsewhere.points) corner.place.x += 100.0;
  EXPECT_THROW(take_volume(scene, {}, read_base("z=0"), elsewhere), Error);
}

}  // namespace
}  // namespace splatray
