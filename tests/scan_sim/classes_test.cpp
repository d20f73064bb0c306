// Crowns of surveys whose files say what points are of, however few these are.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "engine/scene/columns.h"
#include "tests/scan_sim/built_scan.h"

namespace splatray::testing {
namespace {

constexpr double GROUND = 2.0, CROWN = 5.0;

/// A meadow beside a wood of which a survey met the tops alone, so far apart that they look like a hill.
struct ClassedWood {
  static constexpr int SIDE = 80;
  Points points;
  std::vector<double> code;

  /// Whether a point is of the wood.
  [[nodiscard]] bool is_crown(std::size_t i) const { return points.position[i].x > 0.5 * SIDE; }
};

ClassedWood classed_wood() {
  ClassedWood wood;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> jitter(-0.4, 0.4);
  for (int y = 0; y < ClassedWood::SIDE; ++y)
    for (int x = 0; x < ClassedWood::SIDE; ++x) {
      glm::dvec3 place(x + jitter(random), y + jitter(random), 0.1 * jitter(random));
      const bool crown = place.x > 0.5 * ClassedWood::SIDE;
      if (crown) place.z += 12.0 + 2.0 * std::sin(0.3 * place.x) * std::sin(0.3 * place.y);
      wood.points.position.push_back(place);
      wood.code.push_back(crown ? CROWN : GROUND);
    }
  return wood;
}

/// The fraction of the points, of the wood or of the meadow, that are built as surfaces in a file with these classes, or without.
double surface_part(const ClassedWood& wood, bool crowns, const std::vector<double>& code) {
  Points points = wood.points;
  if (!code.empty()) points.columns.push_back({std::string(COLUMN_CLASS), code});
  const Scene scene = build_scan(points).scene;
  const Column* kinds = find_column(scene.columns, COLUMN_KIND);
  double all = 0.0, surface = 0.0;
  for (std::size_t s = 0; s < scene.data_pool.size(); ++s) {
    if (wood.is_crown(number_of(scene, s)) != crowns) continue;
    all += 1.0;
    surface += kinds == nullptr || kinds->number(s) == 0.0 ? 1.0 : 0.0;
  }
  return surface / all;
}

TEST(ScanClasses, CrownsAreScatterHoweverFewTheirPointsAre) {
  const ClassedWood wood = classed_wood();
  EXPECT_GT(surface_part(wood, true, {}), 0.9) << "few points of crowns look like a surface";
  EXPECT_LT(surface_part(wood, true, wood.code), 0.05);
  EXPECT_EQ(surface_part(wood, false, wood.code), surface_part(wood, false, {})) << "the meadow stays";
}

TEST(ScanClasses, AFileOfOneClassTellsNothing) {
  const ClassedWood wood = classed_wood();
  const std::vector<double> one(wood.code.size(), CROWN);
  EXPECT_EQ(surface_part(wood, true, one), surface_part(wood, true, {}));
  EXPECT_EQ(surface_part(wood, false, one), surface_part(wood, false, {}));
}

}  // namespace
}  // namespace splatray::testing
