/// How far answers to rays agree with the truth, and those of two devices with each other.
#pragma once
#include <cstddef>
#include <ostream>
#include <vector>

#include "tests/trace/brute_force.h"

namespace splatray::testing {

struct Agreement {
  std::size_t rays = 0;
  std::size_t hits = 0;          ///< rays that truly hit
  std::size_t hit_or_miss = 0;   ///< rays that hit in one and miss in the other
  std::size_t first_splat = 0;   ///< rays with another first splat
  std::size_t members = 0;       ///< rays with another number of splats in the cluster
  std::size_t normal = 0;        ///< rays whose blended normals differ by more than 0.01 degree
  double normal_most_deg = 0.0;  ///< largest angle between blended normals, degrees
  double depth_most = 0.0;       ///< largest |t - truth| in units of the first splat's radius

  /// Rays that differ in what was hit.
  [[nodiscard]] std::size_t exceptions() const { return hit_or_miss + first_splat; }
};

[[nodiscard]] Agreement agreement_of(const BruteForce& brute, const std::vector<TrueHit>& truth,
                                     const std::vector<RayHit>& answers);

std::ostream& operator<<(std::ostream& out, const Agreement& agreement);

/// By how much answers of two devices may differ (ARCHITECTURE.md, "What devices have in common"). float32's step is 2^-24 of a number, and what Vulkan asks of a device is less than
/// that: quotients to 2.5 steps, inverse square roots to 2, and what is not declared precise may be fused.
/// Of t_first, beside a step for the rounding of it: both devices have it to 2^-44 of the distances involved, which are those of the
/// root, 2^22 at most, and 1 / |n.d| times that; twice, as there are two of them.
inline constexpr double FIRST_ERROR = 0x1p-21;
/// Of a weight, relative: a weight is at least WEIGHT_LEAST = 2^-8, and (1 - u^2)^2 and x^2 (3 - 2 x) then have 1 - u^2 and x of 2^-4
/// at least, off by some four steps of 1, so by 2^-18 of themselves; squares double that, both together double it again.
inline constexpr double WEIGHT_ERROR = 0x1p-16;
/// Of the mean place in the window, in depths of it, from -1 to 1, and of each component of the mean normal, whose parts are turned by
/// 60 degrees at most: a mean of numbers 2 apart moves by twice the weights' relative error. Sums are integers, in steps of 2^-14 of
/// the least weight (WEIGHT_UNIT), which each member may round up or down.
inline constexpr double MEAN_ERROR = 2.0 * WEIGHT_ERROR + 0x1p-14;
/// Of a channel of a colour, whose 8 bits may be rounded to the neighbour.
inline constexpr int COLOR_ERROR = 1;

/// How far answers of two devices are apart.
struct DeviceAgreement {
  std::size_t rays = 0;
  std::size_t hits = 0;       ///< on both devices
  std::size_t decisions = 0;  ///< rays with another object, first splat or number of members
  std::size_t unlike = 0;     ///< these, and rays of which something differs by more than it may
  // Largest differences, as shares of what is allowed:
  double t_first = 0.0;
  double t = 0.0;
  double normal = 0.0;
  double color = 0.0;
};

/// Of the answers `a` and `b` to the same rays. NaN in one alone, or another number of answers, is a decision that differs.
[[nodiscard]] DeviceAgreement device_agreement(const std::vector<RayQuery>& rays,
                                               const std::vector<RayHit>& a, const std::vector<RayHit>& b,
                                               const Settings& settings = {});

/// How many answers are unlike where both devices are processors (`cpus`), which round as IEEE 754 says and fuse nothing: those of
/// other bits; elsewhere DeviceAgreement::unlike.
[[nodiscard]] std::size_t unlike_answers(const std::vector<RayQuery>& rays, const std::vector<RayHit>& a,
                                         const std::vector<RayHit>& b, bool cpus,
                                         const Settings& settings = {});

std::ostream& operator<<(std::ostream& out, const DeviceAgreement& agreement);

}  // namespace splatray::testing
