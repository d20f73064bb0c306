/// Light where none enters.
#pragma once
#include <optional>

#include "app/library/picture/scene_on_device.h"

namespace splatray {

/// A light at the camera where neither the environment nor the lights that scenes have by default reach: where next to none of
/// the directions from the eye lead out of the scene. As bright as makes irradiance pi at the median distance of what the eye
/// sees around it. Nothing for looks that do not trace paths, eyes outside the scene's bounds, orthographic cameras, and scenes
/// that have lights or objects that send out light.
[[nodiscard]] std::optional<SceneLight> eye_light(SceneOnDevice& shown, const Camera& camera,
                                                  const Settings& settings);

}  // namespace splatray
