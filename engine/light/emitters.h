/// The splats of objects that send out light.
#pragma once
#include <memory>
#include <vector>

#include "engine/scene/scene.h"
#include "engine/scene/splat.h"

namespace splatray {

/// A splat that sends out light, and how much.
struct Emitter {
  uvec4 words;
  float power;  ///< mean radiance of rgb times the area that it has for itself (emitter_area.h), > 0

  [[nodiscard]] Splat splat() const { return unpack_splat(words); }  ///< root space
};

/// Each once; null: none. Shared, and compared by its address, as there may be many.
using Emitters = std::shared_ptr<const std::vector<Emitter>>;

/// Radiance that an object of this material sends out: none where it is hidden.
[[nodiscard]] inline vec3 shown_emission(const Material& material) {
  return (material.flags & MATERIAL_HIDDEN) != 0 ? vec3(0.0F) : material.emission;
}

/// The splats of all objects that are to be seen and whose material sends out light. `materials`: one for each object.
[[nodiscard]] Emitters find_emitters(const Scene& scene, const std::vector<Material>& materials);

/// About the irradiance of a surface at the scene's centre that faces the light of emitters, mean of rgb, if nothing is in its
/// way and each splat shines as a ball of its surface does.
[[nodiscard]] double emitted_irradiance(const Scene& scene, const Emitters& emitters);

}  // namespace splatray
