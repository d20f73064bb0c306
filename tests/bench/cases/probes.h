/// Errors of analytic shapes measured by rays from everywhere, finer than a picture can.
#pragma once
#include <cmath>

#include "engine/scene/scene.h"
#include "tests/bench/cases/random_rays.h"
#include "tests/bench/cases/wilson.h"
#include "tests/bench/truth/analytic.h"

namespace splatray::testing {

struct ProbeErrors {
  double normal_rms_deg = NAN;  ///< angle to the true normal
  double jump_p999_deg = NAN;   ///< turn of the normal when the ray moves aside by 0.01 median radii
  double view_inconsistency_p99_deg = NAN;  ///< angle between the normals of one point seen by two rays
  double depth_bias_r = NAN;                ///< mean of distance - true distance, in median radii
  Share holes;      ///< rays that miss, or meet something more than 4 median radii too deep
  Share overhangs;  ///< rays that meet a disc more than 4 median radii before: one past a nearer silhouette
  std::uint64_t rays = 0;  ///< that both are a share of; the angles and depths are of the others
};

/// Sends rays to the shape from all around, uniform in direction and in place, that truly meet it at 78 degrees from its
/// normal or less (cosine 0.2: inside the silhouette). Each ray is rounded to float32 first and its truth computed then.
class Probes {
 public:
  /// About `count` rays for scenes of this transform.
  Probes(Shape shape, const RootTransform& root, std::size_t count, std::uint64_t seed);

  /// The rays, in no order.
  [[nodiscard]] std::span<const RayQuery> rays() const { return rays_; }
  /// The errors of answers. `radius_world`: median radius of the discs.
  [[nodiscard]] ProbeErrors measure(const Intersect& intersect, double radius_world) const;

 private:
  struct Probe {
    glm::dvec3 aside;   ///< unit, perpendicular to the ray
    ShapeHit truth;     ///< root units
    bool seen = false;  ///< the second ray truly meets the same point first
  };
  RootTransform root_;
  std::vector<RayQuery> rays_;
  std::vector<RayQuery> second_;  ///< to the same points from elsewhere
  std::vector<Probe> probes_;
};

}  // namespace splatray::testing
