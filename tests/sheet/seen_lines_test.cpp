// Lines of what is seen, against the edges of what was drawn.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "app/library/cut/line_bridge.h"
#include "app/library/cut/line_doubles.h"
#include "app/library/cut/pixel_borders.h"
#include "app/library/cut/polyline_fit.h"
#include "app/library/sheet/seen_lines.h"

namespace splatray {
namespace {

constexpr std::uint32_t SIDE = 240;
constexpr float EYE = 100.0F;

/// A sheet of SIDE x SIDE pixels, each of one world unit, whose corner is (0, SIDE).
Sheet square_sheet() {
  Sheet sheet;
  sheet.asked.dpi = 300.0;
  sheet.width = sheet.height = SIDE;
  sheet.corner = {0.0, SIDE};
  return sheet;
}

/// What is seen of heights over the sheet, `height(place)`, each pixel by the slope of `normal(place)`.
template <typename Height, typename Normal>
std::vector<AovPixel> seen_of(const Sheet& sheet, const Height& height, const Normal& normal) {
  std::vector<AovPixel> aov(std::size_t{sheet.width} * sheet.height);
  for (std::uint32_t y = 0; y < sheet.height; ++y)
    for (std::uint32_t x = 0; x < sheet.width; ++x) {
      const glm::dvec2 place = sheet.at(x + 0.5, y + 0.5);
      AovPixel& pixel = aov[std::size_t{y} * sheet.width + x];
      pixel.object = 0;
      pixel.z = EYE - static_cast<float>(height(place));
      pixel.normal = normal(place);
    }
  return aov;
}

const auto LEVEL = [](const glm::dvec2&) { return vec3(0.0F, 0.0F, 1.0F); };

/// A rectangle's corners, turned about the sheet's middle.
std::array<glm::dvec2, 4> turned_box(double turn, const glm::dvec2& half) {
  std::array<glm::dvec2, 4> corners;
  const std::array<glm::dvec2, 4> signs{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::dvec2 at = signs[i] * half;
    corners[i] = glm::dvec2(0.5 * SIDE) + glm::dvec2(std::cos(turn) * at.x - std::sin(turn) * at.y,
                                                     std::sin(turn) * at.x + std::cos(turn) * at.y);
  }
  return corners;
}

bool is_in(const std::array<glm::dvec2, 4>& box, const glm::dvec2& place) {
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::dvec2 along = box[(i + 1) % 4] - box[i], to = place - box[i];
    if (along.x * to.y - along.y * to.x < 0.0) return false;
  }
  return true;
}

double farthest_corner(const CutCurve& curve, const std::array<glm::dvec2, 4>& box) {
  double most = 0.0;
  for (const glm::dvec2& corner : box) {
    double least = SIDE;
    for (const glm::dvec2& point : curve.points) least = std::min(least, glm::distance(point, corner));
    most = std::max(most, least);
  }
  return most;
}

TEST(SeenLines, OfATableTurnedByAnyAngleAreItsFourEdges) {
  const Sheet sheet = square_sheet();
  for (double turn = 0.0; turn < 1.5; turn += 0.11) {
    const auto box = turned_box(turn, {70.0, 40.0});
    const auto aov = seen_of(
        sheet, [&](const glm::dvec2& place) { return is_in(box, place) ? 20.0 : 0.0; }, LEVEL);
    const std::vector<CutCurve> lines = seen_lines(sheet, aov);
    ASSERT_EQ(lines.size(), 1U) << turn;
    EXPECT_TRUE(lines[0].closed);
    EXPECT_LE(lines[0].points.size(), 6U) << turn;
    EXPECT_LT(farthest_corner(lines[0], box), 0.8) << turn;
  }
}

TEST(SeenLines, OfRimsThatWanderAreSmooth) {
  Sheet sheet = square_sheet();
  sheet.disc_world = 6.0;
  const auto box = turned_box(0.3, {80.0, 60.0});
  // Discs along the edges that reach over them by up to half a radius.
  std::mt19937 random(3);
  std::uniform_real_distribution<double> over(0.0, 3.0);
  std::vector<std::pair<glm::dvec2, double>> discs;
  for (std::size_t i = 0; i < 4; ++i)
    for (double part = 0.0; part < 1.0; part += 0.03) {
      const glm::dvec2 along = glm::normalize(box[(i + 1) % 4] - box[i]), in(-along.y, along.x);
      discs.emplace_back(glm::mix(box[i], box[(i + 1) % 4], part) + (6.0 - over(random)) * in, 6.0);
    }
  const auto aov = seen_of(
      sheet,
      [&](const glm::dvec2& place) {
        const bool in_disc = std::any_of(discs.begin(), discs.end(), [&](const auto& disc) {
          return glm::distance(place, disc.first) < disc.second;
        });
        return in_disc || is_in(box, place) ? 20.0 : 0.0;
      },
      LEVEL);
  const std::vector<CutCurve> lines = seen_lines(sheet, aov);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_TRUE(lines[0].closed);
  EXPECT_LE(lines[0].points.size(), 8U);
  EXPECT_LT(farthest_corner(lines[0], box), 4.0);
}

TEST(SeenLines, OfARoofAreItsRidgeAlthoughItsNormalsAreBlended) {
  Sheet sheet = square_sheet();
  sheet.disc_world = 5.0;
  const double ridge = 100.3;
  const auto aov = seen_of(
      sheet, [&](const glm::dvec2& place) { return 90.0 - std::abs(place.x - ridge); },
      [&](const glm::dvec2& place) {
        const auto side = static_cast<float>(std::clamp((place.x - ridge) / 4.0, -1.0, 1.0));
        return glm::normalize(vec3(side, 0.0F, 1.0F));
      });
  const std::vector<CutCurve> lines = seen_lines(sheet, aov);
  ASSERT_EQ(lines.size(), 1U);
  for (const glm::dvec2& point : lines[0].points) EXPECT_NEAR(point.x, ridge, 0.6);
  EXPECT_GT(std::abs(lines[0].points.front().y - lines[0].points.back().y), 0.9 * SIDE);
}

TEST(SeenLines, OfASlopeAndOfSpecksAreNone) {
  const Sheet sheet = square_sheet();
  const vec3 leaning = glm::normalize(vec3(-3.0F, 0.0F, 1.0F));
  auto aov = seen_of(
      sheet, [](const glm::dvec2& place) { return 3.0 * place.x; },
      [&](const glm::dvec2&) { return leaning; });
  for (const std::size_t speck : {5000U, 20000U, 40003U}) aov[speck].z -= 40.0F;
  EXPECT_TRUE(seen_lines(sheet, aov).empty());
}

TEST(SeenLines, AreNotBesideWhatIsCut) {
  Sheet sheet = square_sheet();
  const auto box = turned_box(0.0, {70.0, 40.0});
  const auto aov = seen_of(
      sheet, [&](const glm::dvec2& place) { return is_in(box, place) ? 20.0 : 0.0; }, LEVEL);
  sheet.cut_curves = {{{box.begin(), box.end()}, true, 4.0}};
  EXPECT_TRUE(seen_lines(sheet, aov).empty());
}

TEST(SeenLines, OverheadAreMirroredIntoTheSheet) {
  Sheet sheet = square_sheet();
  sheet.cuts = true;
  sheet.near = 7.0;
  sheet.far = -1.0;
  const Sheet above = overhead_sheet(sheet);
  EXPECT_EQ(above.planes().size(), 1U);
  const glm::dvec3 over(30.0, 200.0, 8.0), under(30.0, 200.0, 6.0);
  EXPECT_TRUE(above.planes()[0].holds(over));
  EXPECT_FALSE(above.planes()[0].holds(under));
  const glm::dvec2 place = above.on_paper(over);
  const CutCurve back = mirrored({{{place}, false}})[0];
  EXPECT_EQ(back.points[0], sheet.on_paper(over));
  EXPECT_EQ(above.pixel_of(place).x, SIDE - sheet.pixel_of(back.points[0]).x);
}

TEST(PixelBorders, GoStraightThroughWhereOthersEnd) {
  PixelBorders borders(40, 40);
  for (std::uint32_t x = 0; x < 40; ++x) borders.mark_below(x, 19, PixelBorders::strong);
  for (std::uint32_t y = 20; y < 40; ++y) borders.mark_right(11, y, PixelBorders::strong);
  borders.mark_right(30, 19, PixelBorders::strong);  // a spur
  for (std::uint32_t y = 3; y < 9; ++y) borders.mark_right(5, y, PixelBorders::weak);
  const std::vector<BorderLine> lines = borders.lines(4);
  ASSERT_EQ(lines.size(), 2U);
  std::vector<double> lengths;
  for (const BorderLine& line : lines)
    lengths.push_back(glm::distance(line.points.front(), line.points.back()));
  std::sort(lengths.begin(), lengths.end());
  EXPECT_EQ(lengths, (std::vector<double>{20.0, 40.0}));
}

TEST(Bridges, JoinWhatGoesOnInALineAndNothingElse) {
  const std::vector<CutCurve> curves = {{{{0.0, 0.0}, {10.0, 0.0}}, false},
                                        {{{30.0, 0.2}, {13.0, 0.2}}, false},  // one line, turned
                                        {{{13.0, 5.0}, {13.0, 1.0}}, false},
                                        {{{40.0, 0.2}, {60.0, 0.2}}, false},     // across, too far
                                        {{{11.0, -3.0}, {30.0, -3.0}}, false}};  // beside
  const std::vector<CutCurve> joined = bridged(curves, {5.0, 1.0});
  ASSERT_EQ(joined.size(), 4U);
  EXPECT_EQ(joined[0].points, (std::vector<glm::dvec2>{{0.0, 0.0}, {10.0, 0.0}, {13.0, 0.2}, {30.0, 0.2}}));
  EXPECT_FALSE(joined[0].closed);
  // Three sides of a ring whose gaps lie in their lines.
  const std::vector<CutCurve> ring = {
      {{{1.0, 0.0}, {10.0, 0.0}, {10.0, 4.0}}, false},
      {{{10.0, 6.0}, {10.0, 10.0}, {-5.0, 10.0}, {-5.0, 0.0}, {0.5, 0.0}}, false}};
  const std::vector<CutCurve> around = bridged(ring, {3.0, 1.0});
  ASSERT_EQ(around.size(), 1U);
  EXPECT_TRUE(around[0].closed);
  EXPECT_EQ(around[0].points.size(), 8U);
}

TEST(Doubles, AreLeftOutBesideLongerLines) {
  const CutCurve edge{{{0.0, 0.0}, {20.0, 0.0}}, false}, beside{{{5.0, 0.6}, {9.0, 0.7}}, false},
      across{{{5.0, 0.0}, {5.0, 8.0}}, false}, apart{{{5.0, 1.5}, {9.0, 1.5}}, false};
  const std::vector<CutCurve> kept = without_doubles({beside, across, apart, edge}, 1.0);
  ASSERT_EQ(kept.size(), 3U);
  EXPECT_EQ(kept[0].points, edge.points);
  EXPECT_EQ(kept[1].points, across.points);
  EXPECT_EQ(kept[2].points, apart.points);
}

TEST(Dashes, AreAsLongAsTheyAreOnPaper) {
  const std::vector<CutCurve> dashes = dashed({{{0.0, 0.0}, {10.0, 0.0}, {10.0, 11.0}}, false}, 1.0);
  ASSERT_EQ(dashes.size(), 7U);
  double length = 0.0;
  for (const CutCurve& dash : dashes)
    for (std::size_t i = 1; i < dash.points.size(); ++i)
      length += glm::distance(dash.points[i - 1], dash.points[i]);
  EXPECT_NEAR(length, 14.0, 1e-9);
}

/// Points a unit apart along y = height(x).
std::vector<glm::dvec2> row_of(int length, const std::function<double(int)>& height) {
  std::vector<glm::dvec2> row;
  for (int x = 0; x < length; ++x) row.emplace_back(x, height(x));
  return row;
}

constexpr double ROW_TOLERANCE = 2.0;

/// Rims of discs jut out by up to two tolerances, now here, now there.
TEST(FittedPolyline, OfRimsThatSwingIsOneLine) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> off(-2.0 * ROW_TOLERANCE, 2.0 * ROW_TOLERANCE);
  std::vector<double> rims;
  for (int i = 0; i < 100; ++i) rims.push_back(off(random));
  const auto row = row_of(500, [&](int x) { return rims[static_cast<std::size_t>(x / 5)]; });
  const std::vector<glm::dvec2> line = fitted_polyline(row, false, ROW_TOLERANCE);
  ASSERT_EQ(line.size(), 2U);
  EXPECT_NEAR(line.front().y, 0.0, ROW_TOLERANCE);
  EXPECT_NEAR(line.back().y, 0.0, ROW_TOLERANCE);
  const auto single = row_of(300, [](int x) { return x > 100 && x < 108 ? 2.2 * ROW_TOLERANCE : 0.0; });
  EXPECT_EQ(fitted_polyline(single, false, ROW_TOLERANCE).size(), 2U) << "a rim alone";
}

TEST(FittedPolyline, KeepsCurvesStepsAndNotches) {
  constexpr double RADIUS = 300.0;
  std::vector<glm::dvec2> arc;
  for (int i = 0; i < 900; ++i)
    arc.emplace_back(RADIUS * std::cos(i / RADIUS), RADIUS * std::sin(i / RADIUS));
  for (const glm::dvec2& corner : fitted_polyline(arc, false, ROW_TOLERANCE))
    EXPECT_NEAR(glm::length(corner), RADIUS, 1.5 * ROW_TOLERANCE);
  const auto most_off = [](const std::vector<glm::dvec2>& line, double height) {
    return std::any_of(line.begin(), line.end(),
                       [&](const glm::dvec2& p) { return std::abs(p.y - height) < 0.5; });
  };
  const auto step = row_of(400, [](int x) { return x < 200 ? 0.0 : 3.0 * ROW_TOLERANCE; });
  EXPECT_GE(fitted_polyline(step, false, ROW_TOLERANCE).size(), 4U);
  const auto notch = row_of(400, [](int x) { return x >= 150 && x < 200 ? 2.4 * ROW_TOLERANCE : 0.0; });
  EXPECT_TRUE(most_off(fitted_polyline(notch, false, ROW_TOLERANCE), 2.4 * ROW_TOLERANCE));
}

}  // namespace
}  // namespace splatray
