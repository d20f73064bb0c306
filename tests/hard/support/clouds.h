/// Point clouds of the hard cases, and scenes of them.
#pragma once
#include <glm/glm.hpp>
#include <random>
#include <vector>

#include "engine/scene/scene.h"
#include "preprocess/build.h"
#include "tests/trace/scenes.h"

namespace splatray::testing {

/// A uniformly distributed unit vector.
[[nodiscard]] glm::dvec3 random_unit(std::mt19937_64& random);
/// A uniformly distributed number of [low, high).
[[nodiscard]] double uniform(std::mt19937_64& random, double low, double high);

/// A white mirror, one-sided, that takes no other light.
[[nodiscard]] Material mirror_material();
/// Clear glass without highlights: tint 1.
[[nodiscard]] Material glass_material(float ior);

/// A point with a radius of its own, world units.
struct Disc {
  glm::dvec3 center;
  glm::dvec3 normal;  ///< any length > 0
  double radius;
};
/// An object of discs; their normals are known to point outwards.
[[nodiscard]] InputObject disc_object(const std::vector<Disc>& discs, const Material& material);

/// The objects as a scene; `stats`, if given, gets the counts of the build.
[[nodiscard]] Scene build(const std::vector<InputObject>& objects, const BuildParams& params = {},
                          BuildStats* stats = nullptr);

/// A scene of flat discs whose world is its lattice: discs at integer centres in [64, 2^21 - 64]^3 keep them, as two tiny
/// discs in opposite corners of the root, of an object of their own (index 1), fix the root transform to 1
/// unit per lattice unit.
[[nodiscard]] Scene lattice_scene(const std::vector<Disc>& discs, const Material& material,
                                  std::uint32_t leaf_size = 10);

/// Sum of the discs' areas / `area_world`.
[[nodiscard]] double overlap_of(const Scene& scene, double area_world);
/// Median radius, root units.
[[nodiscard]] double median_radius_root(const Scene& scene);

}  // namespace splatray::testing
