// Truths against closed forms and each other, and errors of pictures whose errors are known.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/base/error.h"
#include "tests/bench/cases/random_rays.h"
#include "tests/bench/cases/statistics.h"
#include "tests/bench/truth/analytic.h"
#include "tests/bench/truth/errors.h"
#include "tests/bench/truth/pixel_rays.h"
#include "tests/readers/read_error.h"

namespace splatray::testing {
namespace {

constexpr double DIAGONAL = 3.4641016151377544;

View view_of_shapes(std::uint32_t size) {
  View view;
  view.camera.eye = {0.8, 1.5, 3.0};
  view.width = view.height = size;
  return view;
}

/// The picture that shows exactly this.
Image picture_of(const Truth& truth) {
  Image image{truth.width, truth.height, {}, {}};
  for (const TruePixel& pixel : truth.pixels) {
    AovPixel shown{};
    shown.normal = vec3(pixel.normal_world);
    shown.z = static_cast<float>(pixel.depth_world);
    shown.object = pixel.hit() ? 0 : NO_OBJECT;
    image.aov.push_back(shown);
  }
  return image;
}

/// Distance of a point from the torus' surface; negative inside.
double torus_distance(const glm::dvec3& p) {
  return std::hypot(std::hypot(p.x, p.z) - TORUS_RING_RADIUS, p.y) - TORUS_TUBE_RADIUS;
}

TEST(AnalyticTruth, SphereFromTheAxisIsAsFarAsItShouldBe) {
  View view;
  view.camera.eye = {0.0, 0.0, 3.0};
  view.width = view.height = 3;
  const TruePixel middle = analytic_truth(Shape::sphere, view).pixels[4];
  EXPECT_DOUBLE_EQ(middle.depth_world, 2.0);
  EXPECT_NEAR(angle_deg(middle.normal_world, {0.0, 0.0, 1.0}), 0.0, 1e-12);
}

TEST(AnalyticTruth, NoRayMeetsTheTorusBeforeItsFirstHit) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(-0.6, 0.6);
  int hits = 0;
  for (int ray = 0; ray < 3000; ++ray) {
    const glm::dvec3 origin = 3.0 * random_direction(random);
    const glm::dvec3 dir = glm::normalize(glm::dvec3(unit(random), unit(random), unit(random)) - origin);
    const auto hit = first_hit(Shape::torus, origin, dir);
    // A sphere about a point with the surface's distance as radius holds no surface (Hart 1996).
    double t = 0.0;
    while (t < 6.0 && torus_distance(origin + t * dir) > 1e-9) t += torus_distance(origin + t * dir);
    ASSERT_EQ(hit.has_value(), t < 6.0);
    if (!hit) continue;
    ++hits;
    EXPECT_NEAR(hit->t, t, 1e-4);
    EXPECT_NEAR(torus_distance(origin + hit->t * dir), 0.0, 1e-12);
    const glm::dvec3 outside = origin + hit->t * dir + 0.01 * hit->normal;
    EXPECT_NEAR(torus_distance(outside), 0.01, 1e-12);
  }
  EXPECT_GT(hits, 500);
}

TEST(TrueEdges, LieOnBothSidesOfStepsAndOfSilhouettes) {
  Truth truth{6, 1, 0.0, std::vector<TruePixel>(6)};
  for (const std::size_t x : {0U, 1U, 2U, 3U}) truth.pixels[x].depth_world = x < 2 ? 1.0 : 1.2;
  mark_edges(truth, 0.1);
  for (std::size_t x = 0; x < 6; ++x) EXPECT_EQ(truth.pixels[x].edge, x != 0 && x != 5) << x;
  mark_edges(truth, 0.3);
  for (std::size_t x = 0; x < 6; ++x) EXPECT_EQ(truth.pixels[x].edge, x == 3 || x == 4) << x;
}

TEST(TruthFile, ComesBackAndIsRefusedWhenShortOrOfAnotherSize) {
  const TempFolder folder;
  const std::filesystem::path path = folder.path() / "truth.bin";
  const Truth truth = analytic_truth(Shape::torus, view_of_shapes(16));
  write_truth(truth, path);
  const Truth back = read_truth(path, 16, 16);
  ASSERT_EQ(back.pixels.size(), truth.pixels.size());
  EXPECT_EQ(back.jump_world, truth.jump_world);
  for (std::size_t i = 0; i < back.pixels.size(); ++i) {
    EXPECT_EQ(back.pixels[i].depth_world, truth.pixels[i].depth_world);
    EXPECT_EQ(back.pixels[i].normal_world, truth.pixels[i].normal_world);
    EXPECT_EQ(back.pixels[i].edge, truth.pixels[i].edge);
  }
  EXPECT_THROW(static_cast<void>(read_truth(path, 16, 8)), Error);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 1);
  EXPECT_THROW(static_cast<void>(read_truth(path, 16, 16)), Error);
}

class KnownErrors : public ::testing::TestWithParam<Shape> {
 protected:
  View view_ = view_of_shapes(64);
  Truth truth_ = analytic_truth(GetParam(), view_);
  Image picture_ = picture_of(truth_);

  [[nodiscard]] Errors errors() const { return errors_of(picture_, truth_, view_, DIAGONAL); }
  /// Pixels off silhouettes that show the shape.
  [[nodiscard]] std::vector<std::size_t> inside() const {
    std::vector<std::size_t> list;
    for (std::size_t i = 0; i < truth_.pixels.size(); ++i)
      if (truth_.pixels[i].hit() && !truth_.pixels[i].edge) list.push_back(i);
    return list;
  }
};

TEST_P(KnownErrors, OfTheTruthItselfAreNone) {
  const Errors errors = this->errors();
  EXPECT_EQ(errors.mismatch_ppm, 0.0);
  EXPECT_LT(errors.depth_abs_p99, 1e-7);
  EXPECT_LT(errors.normal_p99_deg, 1e-5);
  EXPECT_EQ(errors.holes.value, 0.0);
  EXPECT_EQ(errors.hole_rays, inside().size());
  EXPECT_TRUE(std::isinf(errors.psnr_db));
  EXPECT_EQ(errors.flip_mean, 0.0);
}

TEST_P(KnownErrors, OfAnOffsetAreTheOffset) {
  constexpr float OFFSET = 0.01F;
  for (AovPixel& pixel : picture_.aov) pixel.z += OFFSET;
  const Errors errors = this->errors();
  EXPECT_NEAR(errors.depth_signed_mean, OFFSET / DIAGONAL, 1e-7);
  EXPECT_NEAR(errors.depth_abs_median, OFFSET / DIAGONAL, 1e-7);
  EXPECT_NEAR(errors.depth_abs_p99, OFFSET / DIAGONAL, 2e-7);
  EXPECT_EQ(errors.holes.value, 0.0);
}

TEST_P(KnownErrors, OfTiltedNormalsAreTheTilt) {
  constexpr double TILT_DEG = 2.0;
  std::mt19937_64 random(1);
  for (AovPixel& pixel : picture_.aov) {
    if (pixel.object == NO_OBJECT) continue;
    const glm::dvec3 normal(pixel.normal);
    const double tilt = TILT_DEG * std::numbers::pi / 180.0;
    pixel.normal = std::cos(tilt) * normal + std::sin(tilt) * random_across(normal, random);
  }
  const Errors errors = this->errors();
  EXPECT_NEAR(errors.normal_median_deg, TILT_DEG, 1e-4);
  EXPECT_NEAR(errors.normal_p95_deg, TILT_DEG, 1e-4);
  EXPECT_NEAR(errors.normal_p99_deg, TILT_DEG, 1e-4);
  EXPECT_NEAR(errors.normal_rms_deg, TILT_DEG, 1e-4);
  EXPECT_LT(errors.psnr_db, 60.0);
  EXPECT_GT(errors.flip_mean, 0.0);
}

TEST_P(KnownErrors, OfMissingAndDeepPixelsAreTheirNumber) {
  const std::vector<std::size_t> inside = this->inside();
  ASSERT_GT(inside.size(), 100U);
  for (std::size_t i = 0; i < 10; ++i) {
    picture_.aov[inside[i]].object = NO_OBJECT;
    picture_.aov[inside[i]].z = INFINITY;
  }
  for (std::size_t i = 10; i < 15; ++i) picture_.aov[inside[i]].z += 1.0F;
  const Errors errors = this->errors();
  EXPECT_DOUBLE_EQ(errors.mismatch_ppm, 1e6 * 10.0 / 4096.0);
  EXPECT_DOUBLE_EQ(errors.mismatch_inside_ppm, errors.mismatch_ppm);
  EXPECT_EQ(errors.mismatch_edge_ppm, 0.0);
  EXPECT_DOUBLE_EQ(errors.holes.value, 15.0 / static_cast<double>(inside.size()));
  EXPECT_LT(errors.holes.low, errors.holes.value);
  EXPECT_GT(errors.holes.high, errors.holes.value);
}

INSTANTIATE_TEST_SUITE_P(Shapes, KnownErrors, ::testing::Values(Shape::sphere, Shape::torus));

}  // namespace
}  // namespace splatray::testing
