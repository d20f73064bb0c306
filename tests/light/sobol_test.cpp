// The numbers of a path's decisions: even, and better than independent ones.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <set>

#include "tests/light/bsdf_twin.h"

namespace splatray::testing {
namespace {

using Integrand = std::function<double(glm::dvec2)>;

glm::dvec2 pair_of(std::uint32_t pixel, std::uint32_t sample, std::uint32_t group, bool second) {
  const glm::vec4 numbers = twin_sobol_sample(pixel, sample, group, 1);
  return second ? glm::dvec2(numbers.z, numbers.w) : glm::dvec2(numbers.x, numbers.y);
}

TEST(Sobol, EveryPowerOfTwoOfSamplesIsANet) {
  for (const bool second : {false, true})
    for (std::uint32_t pixel = 0; pixel < 20; ++pixel)
      for (std::uint32_t bits = 1; bits <= 10; ++bits)
        for (std::uint32_t wide = 0; wide <= bits; ++wide) {
          std::set<std::pair<int, int>> cells;
          for (std::uint32_t i = 0; i < 1U << bits; ++i) {
            const glm::dvec2 at = pair_of(pixel, i, 3, second);
            ASSERT_TRUE(at.x >= 0.0 && at.x < 1.0 && at.y >= 0.0 && at.y < 1.0);
            cells.emplace(int(at.x * (1U << wide)), int(at.y * (1U << (bits - wide))));
          }
          ASSERT_EQ(cells.size(), 1U << bits)
              << "pixel " << pixel << ", 2^" << bits << " samples, 2^" << wide << " columns";
        }
}

TEST(Sobol, PixelsAndDecisionsAreIndependent) {
  constexpr std::uint32_t PIXELS = 4096;
  double same_pixel = 0.0, same_decision = 0.0, in_pair = 0.0;
  for (std::uint32_t pixel = 0; pixel < PIXELS; ++pixel) {
    const glm::vec4 one = twin_sobol_sample(pixel, 5, 0, 1) - 0.5F;
    same_pixel += double(one.x) * double(twin_sobol_sample(pixel, 5, 1, 1).x - 0.5F);
    same_decision += double(one.x) * double(twin_sobol_sample(pixel + 1, 5, 0, 1).x - 0.5F);
    in_pair += double(one.x) * double(one.z);
  }
  const double five_errors = 5.0 / 12.0 / std::sqrt(double(PIXELS));
  EXPECT_LT(std::abs(same_pixel / PIXELS), five_errors);
  EXPECT_LT(std::abs(same_decision / PIXELS), five_errors);
  EXPECT_LT(std::abs(in_pair / PIXELS), five_errors);
}

/// Root of the mean squared error over pixels.
double sobol_rmse(const Integrand& integrand, double truth, std::uint32_t samples) {
  constexpr std::uint32_t PIXELS = 2000;
  double squares = 0.0;
  for (std::uint32_t pixel = 0; pixel < PIXELS; ++pixel) {
    double sum = 0.0;
    for (std::uint32_t i = 0; i < samples; ++i) sum += integrand(pair_of(pixel, i, 0, false));
    squares += std::pow(sum / samples - truth, 2);
  }
  return std::sqrt(squares / PIXELS);
}

double independent_rmse(const Integrand& integrand, double truth, std::uint32_t samples) {
  std::mt19937_64 dice(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  double squares = 0.0, count = 200000.0;
  for (int i = 0; i < int(count); ++i) squares += std::pow(integrand({unit(dice), unit(dice)}) - truth, 2);
  return std::sqrt(squares / count / samples);
}

double truth_of(const Integrand& integrand) {
  constexpr int STEPS = 2000;
  double sum = 0.0;
  for (int i = 0; i < STEPS; ++i)
    for (int j = 0; j < STEPS; ++j) sum += integrand({(i + 0.5) / STEPS, (j + 0.5) / STEPS});
  return sum / (double(STEPS) * STEPS);
}

/// Light of a square lamp on a plane, off to its side.
double lamp(glm::dvec2 at) {
  const glm::dvec3 to_lamp(at.x + 0.3, at.y - 0.2, 0.7);
  const double distance_squared = glm::dot(to_lamp, to_lamp);
  return to_lamp.z * to_lamp.z / (distance_squared * distance_squared);
}

double checkers(glm::dvec2 at) { return (int(at.x * 37.0) + int(at.y * 41.0)) % 2; }

TEST(Sobol, BetterThanIndependentNumbers) {
  const double lamp_truth = truth_of(lamp),
               ratio = sobol_rmse(lamp, lamp_truth, 16) / independent_rmse(lamp, lamp_truth, 16);
  EXPECT_LE(ratio, 0.2);
  const double board_truth = truth_of(checkers);
  EXPECT_LE(sobol_rmse(checkers, board_truth, 16) / independent_rmse(checkers, board_truth, 16), 1.02);
  RecordProperty("lamp", std::to_string(ratio));
}

TEST(Sobol, ErrorsFallFasterThanWithIndependentNumbers) {
  const double truth = truth_of(lamp);
  const double slope = std::log2(sobol_rmse(lamp, truth, 256) / sobol_rmse(lamp, truth, 4)) / 6.0;
  EXPECT_LE(slope, -0.65);
  RecordProperty("slope", std::to_string(slope));
}

}  // namespace
}  // namespace splatray::testing
