#include "tests/light/chi_squared.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace splatray::testing {
namespace {

using std::numbers::pi;

constexpr int COLUMNS = 48, ROWS = 48, PARTS = 8, EDGE_PARTS = 32;
constexpr int SAMPLES = 100000;
constexpr double EXPECTED_LEAST = 5.0;

/// Columns are angles about z, rows are even steps of z.
int bin_of(const glm::vec3& dir) {
  const double angle = std::atan2(double(dir.y), double(dir.x)) / (2.0 * pi);
  const int column = std::clamp(int((angle < 0.0 ? angle + 1.0 : angle) * COLUMNS), 0, COLUMNS - 1);
  const int row = std::clamp(int((double(dir.z) + 1.0) * 0.5 * ROWS), 0, ROWS - 1);
  return row * COLUMNS + column;
}

/// The probability of a bin by Gauss-Legendre's rule of two points in each of its parts; `edge`: there and not there both occur
/// in it.
double bin_probability(const SampledDirections& directions, int row, int column, int parts, bool& edge) {
  constexpr double POINTS[] = {0.21132486540518713, 0.7886751345948129};
  double sum = 0.0;
  bool some = false, none = false;
  for (int i = 0; i < 2 * parts; ++i)
    for (int j = 0; j < 2 * parts; ++j) {
      const double z = 2.0 * (row + (i / 2 + POINTS[i % 2]) / parts) / ROWS - 1.0;
      const double angle = 2.0 * pi * (column + (j / 2 + POINTS[j % 2]) / parts) / COLUMNS;
      const double sine = std::sqrt(1.0 - z * z);
      const double pdf = directions.pdf({sine * std::cos(angle), sine * std::sin(angle), z});
      sum += pdf;
      (pdf > 0.0 ? some : none) = true;
    }
  edge = some && none;
  return sum * pi / (double(COLUMNS) * ROWS * parts * parts);
}

std::vector<double> expected_counts(const SampledDirections& directions) {
  std::vector<double> expected;
  for (int row = 0; row < ROWS; ++row)
    for (int column = 0; column < COLUMNS; ++column) {
      bool edge = false;
      expected.push_back(SAMPLES * bin_probability(directions, row, column, PARTS, edge));
      if (edge) expected.back() = SAMPLES * bin_probability(directions, row, column, EDGE_PARTS, edge);
    }
  return expected;
}

/// Upper tail of the chi-squared distribution (Wilson and Hilferty 1931), good for many degrees of freedom.
double upper_tail(double chi_squared, double freedom) {
  const double scale = 2.0 / (9.0 * freedom);
  const double z = (std::cbrt(chi_squared / freedom) - (1.0 - scale)) / std::sqrt(scale);
  return 0.5 * std::erfc(z / std::numbers::sqrt2);
}

}  // namespace

double sidak(double significance, std::size_t tests) {
  return 1.0 - std::pow(1.0 - significance, 1.0 / static_cast<double>(tests));
}

double chi_squared_p(const SampledDirections& directions, std::uint64_t seed) {
  std::mt19937_64 dice(seed);
  std::uniform_real_distribution<float> unit(0.0F, 0.99999994F);
  std::vector<double> found(std::size_t(COLUMNS * ROWS), 0.0);
  double none = 0.0;
  for (int i = 0; i < SAMPLES; ++i) {
    glm::vec3 dir(0.0F);
    if (directions.sample({unit(dice), unit(dice), unit(dice)}, dir))
      ++found[std::size_t(bin_of(dir))];
    else
      ++none;
  }
  const std::vector<double> expected = expected_counts(directions);
  double chi_squared = 0.0, freedom = 0.0, few_expected = 0.0, few_found = 0.0, all = 0.0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    all += expected[i];
    if (expected[i] < EXPECTED_LEAST) {
      few_expected += expected[i];
      few_found += found[i];
      continue;
    }
    chi_squared += (found[i] - expected[i]) * (found[i] - expected[i]) / expected[i];
    ++freedom;
  }
  // What is chosen nowhere, as facets mirror below the horizon, is the rest of the probability.
  few_expected += std::max(SAMPLES - all, 0.0);
  few_found += none;
  if (few_expected >= EXPECTED_LEAST) {
    chi_squared += (few_found - few_expected) * (few_found - few_expected) / few_expected;
    ++freedom;
  } else if (few_found > 10.0 * EXPECTED_LEAST) {
    return 0.0;
  }
  return upper_tail(chi_squared, std::max(freedom - 1.0, 1.0));
}

}  // namespace splatray::testing
