#include "tests/bench/truth/flip.h"

#include <gtest/gtest.h>

#include <cmath>

namespace splatray::testing {
namespace {

constexpr std::uint32_t WIDTH = 96;
constexpr std::uint32_t HEIGHT = 64;
using Pixels = std::vector<glm::vec3>;

Pixels flat(const glm::vec3& color) { return Pixels(std::size_t(WIDTH) * HEIGHT, color); }

/// Black, and white from column `at` on.
Pixels edge(std::uint32_t at) {
  Pixels pixels;
  for (std::uint32_t y = 0; y < HEIGHT; ++y)
    for (std::uint32_t x = 0; x < WIDTH; ++x) pixels.emplace_back(x >= at ? 1.0F : 0.0F);
  return pixels;
}

/// Coloured waves about the mean colour `base`, moved by `shift` pixels.
Pixels waves(double shift, const glm::dvec3& base = {0.5, 0.4, 0.6}) {
  Pixels pixels;
  for (std::uint32_t y = 0; y < HEIGHT; ++y)
    for (std::uint32_t x = 0; x < WIDTH; ++x) {
      const glm::dvec3 wave(std::sin(0.20 * (x + shift) + 0.05 * y), std::sin(0.13 * (y + shift) - 0.07 * x),
                            std::cos(0.11 * (x + y + shift)));
      pixels.emplace_back(glm::clamp(base + 0.3 * wave, 0.0, 1.0));
    }
  return pixels;
}

double flip(const Pixels& a, const Pixels& b, double pixels_per_degree = 67.02) {
  return flip_mean(a, b, WIDTH, HEIGHT, pixels_per_degree);
}

TEST(Flip, EqualPicturesHaveNoError) {
  EXPECT_EQ(flip(waves(0.0), waves(0.0)), 0.0);
  EXPECT_EQ(flip_mean({glm::vec3(0.5F)}, {glm::vec3(0.5F)}, 1, 1), 0.0);
}

TEST(Flip, DoesNotDependOnTheOrderOfThePictures) {
  const Pixels a = waves(0.0);
  const Pixels b = edge(40);
  EXPECT_NEAR(flip(a, b), flip(b, a), 1e-12);
}

TEST(Flip, OppositeColoursAreNearlyTheWorst) {
  EXPECT_NEAR(flip(flat(glm::vec3(0.0F, 1.0F, 0.0F)), flat(glm::vec3(0.0F, 0.0F, 1.0F))), 1.0, 1e-6);
  EXPECT_GT(flip(flat(glm::vec3(0.0F)), flat(glm::vec3(1.0F))), 0.95);
}

TEST(Flip, GrowsWithTheDifference) {
  double before = 0.0;
  for (const float step : {0.01F, 0.03F, 0.1F, 0.3F, 0.5F}) {
    const double error = flip(flat(glm::vec3(0.4F)), flat(glm::vec3(0.4F + step)));
    EXPECT_GT(error, before) << step;
    before = error;
  }
}

TEST(Flip, SeesAMovedEdgeAndMoreOfAMissingOne) {
  const double near_by = flip(edge(48), edge(50));
  EXPECT_GT(near_by, 0.02);
  EXPECT_LT(near_by, 0.25);
  EXPECT_GT(flip(edge(48), edge(56)), near_by);
  const double unseen = flip(edge(48), edge(48 + WIDTH));
  EXPECT_GT(unseen, 0.4) << "half the picture is missing";
}

// Values of the authors' own program, flip-evaluator 1.7 from PyPI, for the same pictures (float32 there).
TEST(Flip, AgreesWithTheAuthorsProgram) {
  constexpr double SAME = 1e-4;
  const glm::dvec3 other_base(0.55, 0.4, 0.5);
  EXPECT_NEAR(flip(waves(0.0), waves(1.0)), 0.1937658, SAME);
  EXPECT_NEAR(flip(waves(0.0), waves(0.0, other_base)), 0.2781339, SAME);
  EXPECT_NEAR(flip(edge(48), edge(50)), 0.0556115, SAME);
  EXPECT_NEAR(flip(flat(glm::vec3(0.0F)), flat(glm::vec3(1.0F))), 0.9673266, SAME);
  EXPECT_NEAR(flip(flat(glm::vec3(0.5F)), flat(glm::vec3(0.52F, 0.5F, 0.5F))), 0.0775163, SAME);
  EXPECT_NEAR(flip(waves(0.0), waves(1.0), 30.0), 0.1905508, SAME);
  EXPECT_NEAR(flip(edge(48), edge(50), 30.0), 0.0388913, SAME);
}

}  // namespace
}  // namespace splatray::testing
