// What preprocess makes of leaves and a wire above ground, and of means of leaves.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <random>

#include "engine/scene/splat.h"
#include "preprocess/base/levels.h"
#include "preprocess/build.h"
#include "tests/scan_sim/built_scan.h"

namespace splatray::testing {
namespace {

/// Rolling ground with a ball of leaves and a straight wire above it; numbers of the three follow each other.
struct Glade {
  static constexpr std::size_t GROUND = 10000, LEAVES = 4000, WIRE = 1500;
  InputObject object;
};

Glade glade_with_wire() {
  Glade glade;
  glade.object.material = default_material();
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::normal_distribution<double> normal;
  std::vector<glm::dvec3>& places = glade.object.points.position;
  for (std::size_t i = 0; i < Glade::GROUND; ++i)
    places.emplace_back(20.0 * unit(random) - 10.0, 20.0 * unit(random) - 10.0, 0.0);
  for (glm::dvec3& p : places) p.z = std::sin(0.4 * p.x) * std::cos(0.4 * p.y) + 0.01 * normal(random);
  for (std::size_t i = 0; i < Glade::LEAVES; ++i) {
    const glm::dvec3 dir = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    places.push_back(glm::dvec3(-5.0, -5.0, 4.0) + 2.0 * std::cbrt(unit(random)) * dir);
  }
  for (std::size_t i = 0; i < Glade::WIRE; ++i)
    places.emplace_back(0.01 * normal(random), 20.0 * unit(random) - 10.0, 8.0 + 0.01 * normal(random));
  std::vector<double> numbers(places.size());
  std::iota(numbers.begin(), numbers.end(), 0.0);
  glade.object.points.columns.push_back({std::string(POINT_NUMBER), numbers});
  return glade;
}

TEST(ScanKinds, LeavesFaceTheScannerThatSawThem) {
  const glm::dvec3 sensor(-5.0, 20.0, 4.0);
  Input input;
  input.up = glm::dvec3(0.0, 0.0, 1.0);
  input.objects.push_back(glade_with_wire().object);
  input.objects[0].points.stations = {Station{"", sensor}};
  BuildStats stats;
  const Scene scene = build_scene(std::move(input), {}, 0, stats);
  const Column &number = *find_column(scene.columns, POINT_NUMBER),
               &kinds = *find_column(scene.columns, COLUMN_KIND);
  std::size_t leaves = 0;
  for (std::size_t s = 0; s < scene.data_pool.size(); ++s) {
    const auto i = static_cast<std::size_t>(number.number(s));
    const bool leaf = i >= Glade::GROUND && i < Glade::GROUND + Glade::LEAVES;
    if (!leaf || kinds.number(s) == 0.0) continue;
    const Splat splat = unpack_splat(scene.data_pool[s]);
    const glm::dvec3 to_sensor = glm::normalize(sensor - scene.root.to_world(splat.center));
    EXPECT_GT(glm::dot(glm::dvec3(splat.normal), to_sensor), 0.999) << s;
    ++leaves;
  }
  EXPECT_GT(leaves, Glade::LEAVES * 9 / 10);
}

/// Of each number: the radius and the light that splats of a glade have of which `change` changes the points.
std::map<std::size_t, std::pair<double, double>> discs_of(const std::function<void(Points&)>& change) {
  Input input;
  input.up = glm::dvec3(0.0, 0.0, 1.0);
  input.objects.push_back(glade_with_wire().object);
  Points& points = input.objects[0].points;
  points.color.assign(points.size(), glm::vec3(0.6F));
  change(points);
  BuildStats stats;
  const Scene scene = build_scene(std::move(input), {}, 0, stats);
  const Column& number = *find_column(scene.columns, POINT_NUMBER);
  std::map<std::size_t, std::pair<double, double>> discs;
  for (std::size_t s = 0; s < scene.data_pool.size(); ++s)
    discs[static_cast<std::size_t>(number.number(s))] = {
        std::sqrt(unpack_splat(scene.data_pool[s]).radius_squared), unpack_color(scene.color_pool[s]).g};
  return discs;
}

TEST(ScanKinds, MeansOfLeavesCoverWhatTheirPointsDoAndAreDarker) {
  const auto is_leaf = [](std::size_t i) { return i >= Glade::GROUND && i < Glade::GROUND + Glade::LEAVES; };
  const auto points = discs_of([](Points&) {});
  const auto means = discs_of([](Points& changed) {
    for (std::size_t i = 0; i < changed.size(); ++i)
      changed.mean_of.push_back(i % 3 == 0 ? 64 : i % 3 == 1 ? 1 : 0);
  });
  ASSERT_EQ(points.size(), means.size());
  std::size_t leaves = 0, others = 0;
  for (const auto& [i, point] : points) {
    const auto [radius, light] = means.at(i);
    if (!is_leaf(i) || i % 3 != 0) {
      EXPECT_EQ(means.at(i), point) << i;
      ++others;
    } else if (radius != point.first) {  // but for the few that seem to be of a surface
      EXPECT_NEAR(radius / point.first, 2.0, 0.001) << i;
      EXPECT_NEAR(light / point.second, std::pow(64.0, -1.0 / 12.0), 0.01) << i;
      ++leaves;
    }
  }
  EXPECT_GT(leaves, Glade::LEAVES * 3 / 10);
  EXPECT_GT(others, Glade::GROUND * 9 / 10);
}

TEST(ScanKinds, AttributesOfAFileAreNoCountsOfMeans) {
  const auto of = [](const char* name) {
    return discs_of([&](Points& points) {
      points.columns.push_back({name, std::vector<double>(points.size(), 64.0)});
    });
  };
  EXPECT_EQ(of(COLUMN_POINT_COUNT), of("counts"));
}

TEST(ScanKinds, GroundLeavesAndWiresAreDistinguished) {
  Input input;
  input.up = glm::dvec3(0.0, 0.0, 1.0);
  input.objects.push_back(glade_with_wire().object);
  BuildStats stats;
  const Scene scene = build_scene(std::move(input), {}, 0, stats);
  const Column &number = *find_column(scene.columns, POINT_NUMBER),
               &kinds = *find_column(scene.columns, COLUMN_KIND);
  std::array<std::array<double, SCAN_KINDS>, 3> count{};
  std::vector<double> leaf_radii;
  glm::dvec3 facing(0.0);
  for (std::size_t s = 0; s < scene.data_pool.size(); ++s) {
    const auto i = static_cast<std::size_t>(number.number(s));
    const std::size_t part = i < Glade::GROUND ? 0 : i < Glade::GROUND + Glade::LEAVES ? 2 : 1;
    count[part][static_cast<std::size_t>(kinds.number(s))] += 1.0;
    if (part != 2) continue;
    const Splat splat = unpack_splat(scene.data_pool[s]);
    leaf_radii.push_back(std::sqrt(splat.radius_squared) * scene.root.unit_world);
    facing += splat.normal;
  }
  for (std::size_t part = 0; part < SCAN_KINDS; ++part)
    EXPECT_GT(count[part][part], 0.97 * (count[part][0] + count[part][1] + count[part][2])) << part;
  std::nth_element(leaf_radii.begin(), leaf_radii.begin() + leaf_radii.size() / 2, leaf_radii.end());
  // Six others in a ball of 4 pi d^3 / 3, of 4000 in one of the radius 2.
  const double sixth = 2.0 * std::cbrt(6.0 / static_cast<double>(Glade::LEAVES));
  EXPECT_NEAR(leaf_radii[leaf_radii.size() / 2], 0.4 * sixth, 0.05 * sixth);
  EXPECT_GT(glm::normalize(facing).z, 0.95) << "leaves face outwards and up";
}

}  // namespace
}  // namespace splatray::testing
