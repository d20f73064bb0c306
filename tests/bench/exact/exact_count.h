/// How many answers of a device differ from brute force in float64, kind of ray by kind of ray.
#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "tests/bench/exact/exact_rays.h"
#include "tests/gpu/shown_tracer.h"
#include "tests/trace/brute_force_tree.h"

namespace splatray::testing {

/// Rays compared, and what of them differed.
struct ExactCount {
  std::uint64_t rays = 0;
  std::uint64_t hits = 0;         ///< rays that truly hit
  std::uint64_t hit_or_miss = 0;  ///< hit in one, missed in the other
  std::uint64_t first_splat = 0;  ///< another first splat, ties apart
  /// Another first splat, whose disc the ray meets too, at the same t to 2^-44 of the distance.
  std::uint64_t ties = 0;
  std::uint64_t members = 0;  ///< another number of splats in the cluster
  std::uint64_t normals = 0;  ///< blended normals that differ by more than 0.01 degree

  void add(const ExactCount& more);
  [[nodiscard]] std::uint64_t different_hits() const { return hit_or_miss + first_splat; }
};

/// Compares answers to rays with the truth.
[[nodiscard]] ExactCount count_different(const BruteForce& brute, const std::vector<RayQuery>& rays,
                                         const std::vector<TrueHit>& truth,
                                         const std::vector<RayHit>& answers);

/// A scene on the device and its brute force, with the same materials.
class ExactScene {
 public:
  /// With `in_regions` rays meet what is in a region, another for each seed.
  ExactScene(const Device& device, Scene scene, bool in_regions = false);

  /// Moves a splat in brute force alone, so that comparisons must differ.
  void move_splat(std::size_t index, const glm::dvec3& by_root) { brute_.move_splat(index, by_root); }
  [[nodiscard]] std::uint64_t splats() const { return scene_.data_pool.size(); }

  /// Counts by kind: about `rays` each of primary, shadow, mirrored, refracted and random, and rays / 10 of each of ADVERSARIAL.
  /// Other rays for each seed. Objects are one- or two-sided by the seed; for refracted rays they are of glass. `report` is
  /// called with each kind's count as it is known.
  using Report = std::function<void(const std::string& kind, const ExactCount& count)>;
  void count(std::size_t rays, std::uint64_t seed, const Report& report);

 private:
  /// Rays and what they truly hit.
  struct Traced {
    std::vector<RayQuery> rays;
    std::vector<TrueHit> hits;
  };
  void look(const std::vector<Material>& materials);
  Traced compare(std::vector<RayQuery> rays, ExactCount& count);
  void count_paths(const Traced& first, Next next, std::size_t rays, const glm::dvec3& to_light,
                   ExactCount& count);

  Scene scene_;
  bool in_regions_;
  Settings settings_;
  ShownTracer tracer_;
  BruteForceTree brute_;
};

}  // namespace splatray::testing
