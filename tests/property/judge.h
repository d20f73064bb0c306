/// Whether an answer to a ray is right.
///
/// Right is what tests/trace/agreement.h calls agreement with brute force: the same hit or miss, first splat and cluster
/// size, normals within 0.01 degree, depths within 0.01 of the first splat's radius (and float32's own step at the distance
/// from where the ray enters the root), and colours within a step of 8 bits. Only hit or miss and the first splat are
/// compared for clusters of more than 500 splats, which the shaders do not sum up (MEMBERS_MOST), and where the ray comes
/// within 2^-16 of lying in the plane of a disc near it: then float32 does not resolve where it meets that disc.
///
/// A tie is an answer that is right for splats moved by no more than the rounding that the shaders state, and nothing else:
/// - what decides whether and where a disc is met is exact to 2^-42 of the distances involved (double-float, about 2^-44;
///   brute force in float64 is finer); so each centre may be moved by up to 2^-42 of the ray's way to it;
/// - which splats belong to the sheet left, and which to the cluster and with what weight, is decided in float32: there a
///   centre may be moved by up to 2^-21 of its distance from the ray's origin, or from the first hit, respectively, and the
///   normals of the sheet left and of splats other than the first by 2^-21; the first hit itself stays the same splat.
/// Such moves are tried a fixed number of times, each time by asking brute force again.
#pragma once
#include <cstdint>

#include "engine/image/view.h"
#include "tests/property/dice.h"
#include "tests/trace/brute_force.h"

namespace splatray::testing {

/// edge_on: the first splat is right, its cluster is not, and that is excused as above.
enum class Verdict { right, edge_on, tie, wrong };

class Judge {
 public:
  Judge(const BruteForce& brute, const Settings& settings) : brute_(brute), settings_(settings) {}

  /// `truth` is brute force's answer to `ray`.
  [[nodiscard]] Verdict judge(const RayQuery& ray, const TrueHit& truth, const RayHit& answer) const;

 private:
  /// right, edge_on or wrong.
  [[nodiscard]] Verdict compare(const BruteForce& brute, const RayQuery& ray, const TrueHit& truth,
                                const RayHit& answer) const;
  [[nodiscard]] bool is_right(const BruteForce& brute, const RayQuery& ray, const TrueHit& truth,
                              const RayHit& answer) const {
    return compare(brute, ray, truth, answer) != Verdict::wrong;
  }
  [[nodiscard]] bool is_tie(const RayQuery& ray, const RayHit& answer) const;
  /// The splats moved at random; `favour`: so that the answer's first splat is met earlier and all from there on later, as it takes
  /// luck to put one of many before all others at random.
  [[nodiscard]] BruteForce moved_in_favour(const RayQuery& ray, const RayHit& answer, bool favour,
                                           Dice& dice) const;
  [[nodiscard]] bool is_right_in_float32(const BruteForce& exact, const RayQuery& ray, const TrueHit& truth,
                                         const RayHit& answer, std::uint64_t seed) const;

  const BruteForce& brute_;
  const Settings& settings_;
};

}  // namespace splatray::testing
