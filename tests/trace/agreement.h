/// How far answers to rays agree with the truth.
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

}  // namespace splatray::testing
