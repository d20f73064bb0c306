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

/// Radiance that an object sends out as it is shown: none where it is hidden.
[[nodiscard]] vec3 shown_emission(const ObjectLooks& objects, std::size_t object);

/// The splats of all objects that are to be seen and whose surface sends out light.
[[nodiscard]] Emitters find_emitters(const Scene& scene, const ObjectLooks& objects);

/// About the irradiance of a surface at the scene's centre that faces the light of emitters, mean of rgb, if nothing is in its
/// way and each splat shines as a ball of its surface does.
[[nodiscard]] double emitted_irradiance(const Scene& scene, const Emitters& emitters);

}  // namespace splatray
