/// The scene's splats in float32, and the cluster of discs that a ray meets, for peers.
#pragma once
#include <array>
#include <vector>

#include "engine/image/view.h"
#include "engine/scene/scene.h"

namespace splatray::testing {

/// A splat in root space, lattice units; never across two lines of a cache.
struct alignas(32) Disc {
  vec3 center;
  float radius;
  vec3 normal;  ///< unit
  std::uint32_t object;
};

/// A normal field (unpack_field): a symmetric matrix. Constant terms are left out: no model of the peers' has them.
struct alignas(32) Slope {
  vec3 diagonal;  ///< xx, yy, zz
  vec3 beside;    ///< yz, xz, xy

  [[nodiscard]] vec3 times(const vec3& v) const {
    return diagonal * v + vec3(beside.y * v.z + beside.z * v.y, beside.x * v.z + beside.z * v.x,
                               beside.x * v.y + beside.y * v.x);
  }
};

/// Every splat once, in the order of the octree's leaves (Z-order).
struct Discs {
  std::vector<Disc> list;
  std::vector<Slope> slope;             ///< beside them, or empty: all discs are flat
  std::vector<std::uint8_t> two_sided;  ///< per object: both faces are hit

  [[nodiscard]] std::size_t size() const { return list.size(); }
  [[nodiscard]] std::uint64_t bytes() const {
    return sizeof(Disc) * list.size() + sizeof(Slope) * slope.size();
  }
  [[nodiscard]] bool any_one_sided() const;
  /// Whether the ray's direction meets a face that counts.
  [[nodiscard]] bool faces(std::size_t disc, const vec3& dir) const {
    return two_sided[list[disc].object] != 0 || glm::dot(list[disc].normal, dir) < 0.0F;
  }
};

[[nodiscard]] Discs discs_of(const Scene& scene);

/// The surface where a ray meets a disc's plane, by the disc's normal field.
struct DiscFacet {
  vec3 normal;  ///< unit, turned against the ray
  float t;
};
/// `from_center`: the point of the disc that the ray, of unit direction, meets at t, relative to its centre.
[[nodiscard]] DiscFacet facet_of(const Discs& discs, std::size_t disc, float t, const vec3& from_center,
                                 const vec3& dir);

/// The discs that one ray meets, in any order, as a traversal finds them.
class Gathering {
 public:
  Gathering() {}  // NOLINT(modernize-use-equals-default): met_ is not set to zero for every ray

  /// Notes that the ray meets `disc` at t. Discs beyond the window of the nearest one so far, and those that find no
  /// more room, are left out. `dir` is unit.
  void add(std::size_t disc, float t, const vec3& dir, const Discs& discs, const Settings& settings);

  /// Nothing farther than this can belong to the cluster: the end of the nearest disc's window (BLEND_NEAREST: its t).
  /// A nearer disc may open a deeper window later; what lay behind the first one's end is then lost (weights are
  /// nearly zero there).
  [[nodiscard]] float end() const { return end_; }

  /// The answer (ARCHITECTURE.md, "What a hit is"): the nearest disc's facet, or the weighted mean of its cluster's. Settings
  /// used: blend, kernel, kappa.
  [[nodiscard]] RayHit blended(const RayQuery& ray, const Discs& discs, const Settings& settings) const;

 private:
  struct Meeting {
    float t;
    std::uint32_t disc;
  };
  /// The mean cluster has 2 to 4 discs, 12 with dense random sampling.
  static constexpr std::size_t MOST = 64;

  std::array<Meeting, MOST> met_;
  std::size_t count_ = 0;
  Meeting first_{INFINITY, 0};
  float depth_ = 0.0F;
  float end_ = INFINITY;
};

}  // namespace splatray::testing
