/// The light that a picture is seen in, and how bright it is shown.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "app/library/shot/scene_facts.h"
#include "app/library/shot/scene_on_device.h"
#include "app/library/shot/shot.h"

namespace splatray {

/// A scene's look in a picture's lights, and what is to be said of them.
struct LitLook {
  Look look;
  std::vector<std::string> notes{};  ///< sentences
};

/// The light at the camera inside a scene where no light and no environment is asked for, and hardly any of the default light is
/// found by the first samples of a small picture.
[[nodiscard]] std::optional<SceneLight> light_at_camera(const Shot& shot, SceneOnDevice& shown,
                                                        const Camera& camera);

/// In the lights that the request asks for, else the default ones, or that of light_at_camera.
[[nodiscard]] LitLook lit_look(const Shot& shot, SceneOnDevice& shown, const Camera& camera);

/// Begins to build the programs of the shot's first picture, in the light that is known before any is traced: for Tracer::Planned. But where the
/// threads that build them are what uploads, too.
void prepare_programs(const Shot& shot, SceneOnDevice& shown);

/// The exposure, stops in hundredths, that automatic_exposure_ev gives a small picture of the whole view, at most 160 pixels wide
/// and high; in daylight and in a scene's own lights up to 1.5 stops more: that by which white sends out 1 in the open. Parts of a
/// picture, and all pictures of a run, have one exposure by it.
[[nodiscard]] double preview_exposure_ev(const Shot& shot, SceneOnDevice& shown, const Camera& camera);

/// Chooses the exposure where that is left to the picture, by the first of the shot's pictures; of a scene that has an overview by that, so
/// that it does not depend on what was read.
void expose(Shot& shot, SceneOnDevice& shown, const SceneFacts& facts);

}  // namespace splatray
