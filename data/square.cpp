#include "data/square.h"

#include <cmath>
#include <numbers>
#include <random>

namespace splatray {
namespace {

/// The next number of [0,1), from the upper 53 bits, so that every platform gives the same.
double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11U) * 0x1p-53; }

}  // namespace

std::vector<glm::dvec2> unit_square(const Sampling& sampling) {
  std::vector<glm::dvec2> points;
  points.reserve(sampling.count);
  std::mt19937_64 random(sampling.seed);
  const double shift = uniform(random);
  for (std::uint64_t i = 0; i < sampling.count; ++i) {
    if (sampling.even) {
      const auto index = static_cast<double>(i);
      const double turns = index / std::numbers::phi + shift;
      points.emplace_back((index + 0.5) / static_cast<double>(sampling.count), turns - std::floor(turns));
    } else {
      const double u = uniform(random);
      points.emplace_back(u, uniform(random));
    }
  }
  return points;
}

}  // namespace splatray
