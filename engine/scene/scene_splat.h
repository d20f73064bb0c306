/// The one reader of a scene's splats, in world units. What builds and traces trees reads the pools themselves, in root space.
#pragma once
#include <cmath>
#include <cstddef>
#include <span>

#include "engine/scene/scene.h"
#include "engine/scene/splat.h"

namespace splatray {

/// A splat in world units. Each number is decoded where it is asked for: whoever drops most splats by their centres does not pay
/// for their normals. Valid as long as the scene is.
class SceneSplat {
 public:
  /// `words`: of a splat of the scene, such as the one that a ray met (RayHit::first).
  SceneSplat(const Scene& scene, const uvec4& words) : root_(scene.root), words_(words) {}

  [[nodiscard]] glm::dvec3 center_world() const { return root_.to_world(unpack_center(words_)); }
  [[nodiscard]] glm::dvec3 normal() const { return unpack_splat(words_).normal; }  ///< unit
  [[nodiscard]] double radius_world() const {
    return std::sqrt(unpack_radius_squared(words_)) * root_.unit_world;
  }
  [[nodiscard]] std::uint32_t object() const { return words_.w & OBJECT_MASK; }
  /// As trees and rays have it, lattice units.
  [[nodiscard]] Splat in_root() const { return unpack_splat(words_); }
  /// What rays tell splats apart by.
  [[nodiscard]] const uvec4& words() const { return words_; }

 private:
  const RootTransform& root_;
  uvec4 words_;
};

[[nodiscard]] inline std::size_t splat_count(const Scene& scene) { return scene.data_pool.size(); }

/// The splat of an index below splat_count().
[[nodiscard]] inline SceneSplat splat_at(const Scene& scene, std::size_t index) {
  return {scene, scene.data_pool[index]};
}

/// Calls visit(index, SceneSplat) for the splats 0, stride, 2 stride and so on, in the scene's order. `stride`: 1 or more. All of
/// them: a visitor asks its Region after what is cheaper to ask and drops more.
template <typename Visit>
void for_each_splat(const Scene& scene, const Visit& visit, std::size_t stride = 1) {
  const std::span<const uvec4> splats(scene.data_pool);
  for (std::size_t i = 0; i < splats.size(); i += stride) visit(i, SceneSplat(scene, splats[i]));
}

}  // namespace splatray
