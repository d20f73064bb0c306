/// Whether directions are chosen as often as their probability says: Pearson's chi-squared test over bins of the sphere.
#pragma once
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>

namespace splatray::testing {

/// A way to choose directions.
struct SampledDirections {
  /// The unit direction that three numbers in [0, 1) choose; false where they choose none.
  std::function<bool(const glm::vec3& random, glm::vec3& dir)> sample;
  std::function<double(const glm::vec3& dir)> pdf;  ///< probability per solid angle
};

/// The p-value: how often a right sampler would be as far off. Bins that expect fewer than five are put together.
[[nodiscard]] double chi_squared_p(const SampledDirections& directions, std::uint64_t seed);

/// The significance of one of `tests` so that all together have `significance` (Sidak 1967).
[[nodiscard]] double sidak(double significance, std::size_t tests);

}  // namespace splatray::testing
