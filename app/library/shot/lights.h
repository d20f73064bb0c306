/// The lights of a picture.
#pragma once
#include <vector>

#include "app/library/request/request.h"
#include "engine/scene/scene.h"

namespace splatray {

/// The lights: --light and --sun, else the scene's own, else the key light of the look, none where an environment is named. Throws
/// Error (usage) where there are too many.
[[nodiscard]] std::vector<SceneLight> resolve_lights(const Scene& scene, const Request& request,
                                                     const Camera& camera);

/// Lights as a look (LOOK_*) takes them: LOOK_PAPER, which knows no sizes, has points in place of rectangles, as bright straight ahead.
[[nodiscard]] std::vector<SceneLight> lights_of_look(std::uint32_t look, std::vector<SceneLight> lights);

}  // namespace splatray
