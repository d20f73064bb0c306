/// Random numbers of a round: the same on every machine for the same seed.
#pragma once
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <random>

namespace splatray::testing {

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed) {}

  [[nodiscard]] std::uint64_t seed() { return random_(); }
  /// Uniform in [0, 1).
  [[nodiscard]] double unit() { return double(random_() >> 11U) * 0x1p-53; }
  [[nodiscard]] double between(double low, double high) { return low + (high - low) * unit(); }
  /// Uniform in the logarithm; 0 < low <= high.
  [[nodiscard]] double log_between(double low, double high) { return low * std::pow(high / low, unit()); }
  /// Uniform in 0 .. count - 1; count > 0.
  [[nodiscard]] std::uint32_t below(std::uint32_t count) { return std::uint32_t(unit() * double(count)); }
  [[nodiscard]] bool chance(double probability) { return unit() < probability; }
  [[nodiscard]] double sign() { return chance(0.5) ? 1.0 : -1.0; }
  [[nodiscard]] glm::dvec3 in_cube() { return {between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0)}; }
  /// Uniform on the unit sphere.
  [[nodiscard]] glm::dvec3 direction() {
    glm::dvec3 v = in_cube();
    while (glm::dot(v, v) > 1.0 || glm::dot(v, v) < 1e-4) v = in_cube();
    return glm::normalize(v);
  }
  /// One of the six axis directions.
  [[nodiscard]] glm::dvec3 axis() {
    glm::dvec3 v(0.0);
    v[int(below(3))] = sign();
    return v;
  }

 private:
  std::mt19937_64 random_;
};

}  // namespace splatray::testing
