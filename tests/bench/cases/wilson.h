/// How sure a share is that was counted on a sample.
#pragma once
#include <cmath>
#include <cstdint>

namespace splatray::testing {

/// A share and the interval it lies in with 95 % confidence, all 0..1.
struct Share {
  double value = 0.0;
  double low = 0.0;
  double high = 1.0;
};

/// The share of `successes` in `trials` > 0, with its score interval (Wilson 1927, "Probable Inference, the Law of
/// Succession, and Statistical Inference"), which stays meaningful at 0 successes.
[[nodiscard]] inline Share wilson_share(std::uint64_t successes, std::uint64_t trials) {
  constexpr double Z = 1.959963984540054;  // 97.5 % quantile of the normal distribution
  const auto n = static_cast<double>(trials);
  const double share = static_cast<double>(successes) / n;
  const double scale = 1.0 / (1.0 + Z * Z / n);
  const double middle = scale * (share + Z * Z / (2.0 * n));
  const double half = scale * Z * std::sqrt(share * (1.0 - share) / n + Z * Z / (4.0 * n * n));
  return {share, successes == 0 ? 0.0 : middle - half, successes == trials ? 1.0 : middle + half};
}

}  // namespace splatray::testing
