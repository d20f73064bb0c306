/// What a scene is seen in. An image is a value of four: image = render(scene, look, view, settings).
#pragma once
#include <memory>
#include <vector>

#include "engine/light/emitters.h"
#include "engine/scene/environment.h"
#include "engine/scene/scene.h"

namespace splatray {

struct Look {
  std::vector<Material> materials;  ///< one for each object of the scene
  std::vector<SceneLight> lights;   ///< at most LIGHTS_MOST, of them LIGHTS_SIZED_MOST that have a size
  /// Where paths look for light that objects send out: find_emitters() of the scene and the materials, or null, where such light is
  /// met by chance alone: correct, but noisier.
  Emitters emitters;
  /// Null: black all around. Shared, and compared by its address, as it may be large.
  std::shared_ptr<const Environment> environment;
  glm::dvec3 up{0.0, 1.0, 0.0};  ///< the environment stands about it; any length > 0
};

/// A scene's own look, in a black environment. The scene has its pools.
[[nodiscard]] Look look_of(const Scene& scene);

/// Gives a look these materials, and their emitters where they send out other light than before. The scene has its pools.
void show_materials(const Scene& scene, std::vector<Material> materials, Look& look);

}  // namespace splatray
