/// Rays from anywhere in the world as the tracer takes them.
#pragma once
#include <optional>

#include "engine/scene/scene.h"

namespace splatray {

/// A ray that meets the root cube: the query, and what is added to its t.
struct AimedRay {
  RayQuery query{};
  double start = 0.0;  ///< lattice units
};

/// Begins a ray, world space, `dir` unit, where it enters the root cube, as float32 is finest there; nothing for one that passes it.
[[nodiscard]] std::optional<AimedRay> aim_ray(const RootTransform& root, const glm::dvec3& origin_world,
                                              const glm::dvec3& dir);

}  // namespace splatray
