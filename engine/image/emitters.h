/// Where light comes from that objects send out.
#pragma once
#include <span>
#include <vector>

#include "engine/scene/scene.h"

namespace splatray {

/// A ball that holds some of the splats that send out light.
struct Emitter {
  glm::dvec3 center{0.0};  ///< root space
  double radius = 0.0;     ///< lattice units, > 0
  double power = 0.0;      ///< mean radiance of rgb times the splats' area, > 0
  bool operator==(const Emitter&) const = default;
};

/// Radiance that an object sends out as it is shown: none where it is hidden.
[[nodiscard]] vec3 shown_emission(const ObjectLooks& objects, std::size_t object);

inline constexpr std::size_t EMITTERS_MOST = 16;

/// Balls around the splats of all objects that are to be seen and whose surface sends out light: one each, divided where parts
/// lie apart or in a line, as long as that makes the balls much smaller.
[[nodiscard]] std::vector<Emitter> find_emitters(const Scene& scene, const ObjectLooks& objects);

}  // namespace splatray
