// What a plane cuts of a scanned room, against the room.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "app/library/cut/cut_hatch.h"
#include "app/library/cut/plane_cut.h"
#include "preprocess/build.h"

namespace splatray {
namespace {

constexpr double ROOM_HEIGHT = 2.8, SPACING = 0.02, NOISE = 0.001;
constexpr double CUT_HEIGHT = 1.2, TOLERANCE = 0.00025;  ///< as sheets at 1 : 50 have it

/// A wall's line in plan, its front to the left.
struct Wall {
  glm::dvec2 from, to;
};
/// A room of 6 x 4 with a wall of 50 mm that stands 2 m into it, a pillar of 0.4 x 0.4, and a round column.
const std::vector<Wall> WALLS = [] {
  const std::array<glm::dvec2, 8> room{
      {{0.0, 0.0}, {6.0, 0.0}, {6.0, 4.0}, {2.05, 4.0}, {2.05, 2.0}, {2.0, 2.0}, {2.0, 4.0}, {0.0, 4.0}}};
  const std::array<glm::dvec2, 4> pillar{{{4.5, 1.5}, {4.5, 1.9}, {4.9, 1.9}, {4.9, 1.5}}};
  std::vector<Wall> walls;
  for (std::size_t i = 0; i < room.size(); ++i) walls.push_back({room[i], room[(i + 1) % room.size()]});
  for (std::size_t i = 0; i < pillar.size(); ++i)
    walls.push_back({pillar[i], pillar[(i + 1) % pillar.size()]});
  return walls;
}();
const glm::dvec2 COLUMN(1.0, 1.2);
constexpr double COLUMN_RADIUS = 0.2;
constexpr double ROOM_AREA = 6.0 * 4.0 - 2.0 * 0.05;

double distance_to(const glm::dvec2& point, const glm::dvec2& from, const glm::dvec2& to) {
  const glm::dvec2 along = to - from;
  return glm::distance(
      point, from + std::clamp(glm::dot(point - from, along) / glm::dot(along, along), 0.0, 1.0) * along);
}

double distance_to_truth(const glm::dvec2& point) {
  double least = std::abs(glm::distance(point, COLUMN) - COLUMN_RADIUS);
  for (const Wall& wall : WALLS) least = std::min(least, distance_to(point, wall.from, wall.to));
  return least;
}

/// Points every SPACING, moved by chance along the surfaces, and off them by the noise.
class Scanner {
 public:
  void add_wall(const Wall& wall) {
    const double length = glm::distance(wall.from, wall.to);
    const glm::dvec2 along = (wall.to - wall.from) / length, front(-along.y, along.x);
    grid(length, ROOM_HEIGHT, [&](double x, double z) { add({wall.from + x * along, z}, {front, 0.0}); });
  }
  void add_column() {
    grid(2.0 * std::numbers::pi * COLUMN_RADIUS, ROOM_HEIGHT, [&](double x, double z) {
      const double turn = x / COLUMN_RADIUS;
      const glm::dvec2 front(std::cos(turn), std::sin(turn));
      add({COLUMN + COLUMN_RADIUS * front, z}, {front, 0.0});
    });
  }
  void add_floor_and_ceiling() {
    for (const double z : {0.0, ROOM_HEIGHT})
      grid(6.0, 4.0, [&](double x, double y) {
        const bool in_pillar =
            x > 4.5 && x < 4.9 && y > 1.5 && y<1.9, in_wall = x> 2.0 && x < 2.05 && y > 2.0;
        if (in_pillar || in_wall || glm::distance({x, y}, COLUMN) < COLUMN_RADIUS) return;
        add({x, y, z}, {0.0, 0.0, z > 0.0 ? -1.0 : 1.0});
      });
  }
  std::vector<glm::dvec3> places;

 private:
  template <typename Add>
  void grid(double width, double height, const Add& add_at) {
    std::uniform_real_distribution<double> part(0.0, 1.0);
    for (double x = 0.0; x < width; x += SPACING)
      for (double y = 0.0; y < height; y += SPACING)
        add_at(std::min(x + SPACING * part(random_), width), std::min(y + SPACING * part(random_), height));
  }
  void add(const glm::dvec3& place, const glm::dvec3& front) {
    places.push_back(place + std::normal_distribution(0.0, NOISE)(random_) * front);
  }

  std::mt19937 random_{5};
};

/// Built from places alone, as a scan without normals is.
const Scene& room() {
  static const Scene scene = [] {
    Scanner scanner;
    for (const Wall& wall : WALLS) scanner.add_wall(wall);
    scanner.add_column();
    scanner.add_floor_and_ceiling();
    Input input;
    input.objects.emplace_back().points.position = scanner.places;
    BuildStats stats;
    return build_scene(std::move(input), {}, 0, stats);
  }();
  return scene;
}

const std::vector<CutCurve>& plan() {
  static const std::vector<CutCurve> curves =
      plane_cut(room(), {}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, CUT_HEIGHT}, TOLERANCE);
  return curves;
}

std::vector<Wall> segments(const std::vector<CutCurve>& curves) {
  std::vector<Wall> parts;
  for (const CutCurve& curve : curves) {
    const std::size_t count = curve.points.size();
    for (std::size_t i = curve.closed ? 0 : 1; i < count; ++i)
      parts.push_back({curve.points[(i + count - 1) % count], curve.points[i]});
  }
  return parts;
}

/// Calls visit(place) every millimetre of the lines.
template <typename Visit>
void for_each_millimetre(const std::vector<Wall>& lines, const Visit& visit) {
  for (const Wall& line : lines) {
    const double length = glm::distance(line.from, line.to);
    for (double at = 0.0005; at < length; at += 0.001) visit(line.from + at / length * (line.to - line.from));
  }
}

double area_of(const CutCurve& curve) {
  double twice = 0.0;
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const glm::dvec2 a = curve.points[i] - curve.points[0],
                     b = curve.points[(i + 1) % curve.points.size()] - curve.points[0];
    twice += a.x * b.y - a.y * b.x;
  }
  return 0.5 * twice;
}

/// The thin wall's end is two or three points wide, too few for a surface: it is drawn straight across, where the points end.
bool is_at_thin_end(const glm::dvec2& place) { return glm::distance(place, {2.025, 2.0}) < 0.06; }

TEST(PlaneCut, IsWithinAMillimetreOfTheRoom) {
  std::size_t all = 0, near = 0, near_moved = 0;
  double most = 0.0;
  for_each_millimetre(segments(plan()), [&](const glm::dvec2& place) {
    ++all;
    near += distance_to_truth(place) <= 0.001 ? 1 : 0;
    near_moved += distance_to_truth(place + glm::dvec2(0.0015)) <= 0.001 ? 1 : 0;
    if (!is_at_thin_end(place)) most = std::max(most, distance_to_truth(place));
  });
  std::printf("%zu mm, %.4f within 1 mm, at most %.2f mm off\n", all, double(near) / double(all), 1e3 * most);
  EXPECT_GE(double(near), 0.99 * double(all));
  EXPECT_LT(most, 0.002) << "a pimple";
  EXPECT_LT(double(near_moved), 0.5 * double(all)) << "the comparison sees 1.5 mm";
}

TEST(PlaneCut, ShowsAllOfTheRoom) {
  const std::vector<Wall> drawn = segments(plan());
  std::size_t all = 0, found = 0;
  const auto look = [&](const glm::dvec2& place) {
    ++all;
    found += std::any_of(drawn.begin(), drawn.end(),
                         [&](const Wall& line) { return distance_to(place, line.from, line.to) <= 0.001; })
                 ? 1
                 : 0;
  };
  for_each_millimetre(WALLS, look);
  for (double turn = 0.0; turn < 2.0 * std::numbers::pi; turn += 0.001 / COLUMN_RADIUS)
    look(COLUMN + COLUMN_RADIUS * glm::dvec2(std::cos(turn), std::sin(turn)));
  std::printf("%zu mm of the room, %.4f drawn\n", all, double(found) / double(all));
  EXPECT_GE(double(found), 0.99 * double(all));
}

TEST(PlaneCut, IsThreeClosedCurvesWithCorners) {
  ASSERT_EQ(plan().size(), 3U);
  std::vector<double> areas;
  for (const CutCurve& curve : plan()) {
    EXPECT_TRUE(curve.closed);
    areas.push_back(std::abs(area_of(curve)));
  }
  std::sort(areas.begin(), areas.end());
  EXPECT_NEAR(areas[0], std::numbers::pi * COLUMN_RADIUS * COLUMN_RADIUS, 0.001);
  EXPECT_NEAR(areas[1], 0.16, 0.001);
  EXPECT_NEAR(areas[2], ROOM_AREA, 0.005);
  for (const Wall& wall : WALLS) {
    double least = 1.0;
    for (const CutCurve& curve : plan())
      for (const glm::dvec2& point : curve.points) least = std::min(least, glm::distance(point, wall.from));
    EXPECT_LT(least, 0.003) << wall.from.x << ", " << wall.from.y;
  }
}

bool is_solid(const glm::dvec2& place) {
  const auto in_box = [&place](const glm::dvec2& low, const glm::dvec2& high) {
    return place.x >= low.x && place.y >= low.y && place.x <= high.x && place.y <= high.y;
  };
  return !in_box({0.0, 0.0}, {6.0, 4.0}) || in_box({2.0, 2.0}, {2.05, 4.0}) ||
         in_box({4.5, 1.5}, {4.9, 1.9}) || glm::distance(place, COLUMN) < COLUMN_RADIUS;
}

TEST(CutHatch, IsInWhatIsSolidAndNowhereElse) {
  const HatchStyle style{0.02, 0.1, 1.5};
  std::vector<Wall> lines;
  for (const auto& [from, to] : cut_hatch(plan(), style)) lines.push_back({from, to});
  std::size_t all = 0, solid = 0, pillar = 0, column = 0, thin = 0, outside = 0;
  for_each_millimetre(lines, [&](const glm::dvec2& place) {
    ++all;
    solid += is_solid(place) || distance_to_truth(place) < 0.002 ? 1 : 0;
    pillar += glm::distance(place, {4.7, 1.7}) < 0.3 ? 1 : 0;
    column += glm::distance(place, COLUMN) < 0.25 ? 1 : 0;
    thin += glm::distance(place, {2.025, 3.0}) < 0.5 ? 1 : 0;
    outside += place.x < -0.11 || place.y < -0.11 ? 1 : 0;
  });
  EXPECT_EQ(solid, all) << "air is hatched";
  const double line_area = 0.001 * style.spacing;
  EXPECT_NEAR(line_area * double(pillar), 0.16, 0.008);
  EXPECT_NEAR(line_area * double(column), std::numbers::pi * COLUMN_RADIUS * COLUMN_RADIUS, 0.006);
  EXPECT_NEAR(line_area * double(thin), 0.05, 0.004) << "a wall of 50 mm, a metre long";
  EXPECT_EQ(outside, 0U) << "where nothing is known";
  std::vector<CutCurve> turned = plan();
  for (CutCurve& curve : turned) std::reverse(curve.points.begin(), curve.points.end());
  double air = 0.0;
  for (const auto& [from, to] : cut_hatch(turned, style))
    air += is_solid(0.5 * (from + to)) ? 0.0 : glm::distance(from, to);
  EXPECT_GT(air, 10.0) << "the comparison sees backs that are fronts";
}

TEST(PlaneCut, EndsWhereTheRegionDoes) {
  Region region;
  region.kept = {{{3.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}};
  const std::vector<CutCurve> curves =
      plane_cut(room(), region, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, CUT_HEIGHT}, TOLERANCE);
  ASSERT_EQ(curves.size(), 2U) << "half of the room, and the pillar";
  double left = 6.0;
  for (const CutCurve& curve : curves)
    for (const glm::dvec2& point : curve.points) left = std::min(left, point.x);
  EXPECT_NEAR(left, 3.0, 0.005);
  EXPECT_GE(left, 3.0);
}

}  // namespace
}  // namespace splatray
