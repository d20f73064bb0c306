/// From options to the scene that is shown.
#pragma once
#include <functional>
#include <string>

#include "app/cli/options.h"
#include "engine/scene/environment.h"
#include "preprocess/build.h"

namespace splatray {

/// A scene and how it came to be.
struct LoadedScene {
  Scene scene;
  std::string environment_name;     ///< as choose_environment_name has it
  double load_ms = 0.0;             ///< reading and preprocess
  std::optional<BuildStats> build;  ///< unless read from a .soct
  ColorLegend legend{};             ///< of PictureOptions::attributes
};

/// Who hears of loading, on its thread; each may be empty.
struct LoadListener {
  Progress progress;  ///< returns false to stop: load_scene then throws Error (interrupted)
  std::function<void(const std::string&)> note;  ///< a sentence about something odd in the files
};

/// Throws Error (usage) where a .soct, which is a whole scene, is not the only input.
void require_scene_alone(const std::vector<std::filesystem::path>& inputs);

/// Reads or preprocesses the scene; applies --material, --object, --up and what is shown of attributes. Throws Error.
[[nodiscard]] LoadedScene load_scene(const SceneOptions& scene, const PictureOptions& picture,
                                     const LoadListener& listener);

/// The camera the options ask for: --eye, else the scene's own, else a view of the whole scene.
[[nodiscard]] Camera choose_camera(const Scene& scene, const PictureOptions& picture);

/// The lights a scene is shown in that nothing else is said of: its own, else the key light of a look (LOOK_*), none where an environment
/// is named.
[[nodiscard]] std::vector<SceneLight> own_lights(const Scene& scene, bool environment_named,
                                                 std::uint32_t look, const Camera& camera);
/// The lights: --light and --sun, else own_lights.
[[nodiscard]] std::vector<SceneLight> choose_lights(const Scene& scene, const PictureOptions& picture,
                                                    const Camera& camera);

/// The up direction: --up, else the scene's.
[[nodiscard]] glm::dvec3 choose_up(const Scene& scene, const PictureOptions& picture);
/// The environment's name: --env, else what the scene names; empty = none.
[[nodiscard]] std::string choose_environment_name(const Scene& scene, const PictureOptions& picture);

/// The option that makes a light.
[[nodiscard]] LightOptions light_options(const SceneLight& light);

/// The environment of a name that needs no file: white, black, studio or r,g,b, empty = studio; nothing for other names.
/// Throws Error (usage) for a radiance that is negative or not finite.
[[nodiscard]] std::optional<Environment> built_in_environment(const std::string& name);
/// The environment `name` of --env: a file, white, black, studio, r,g,b; empty = studio. Throws Error
/// (input_unreadable).
[[nodiscard]] Environment choose_environment(const std::string& name);

/// The look, LOOK_*: that of --look, else LOOK_SCAN for scans in no light of their own or of the options' and without materials of
/// either, else LOOK_LIT.
[[nodiscard]] std::uint32_t choose_look(const Scene& scene, const PictureOptions& picture);
/// Whether a look shows materials: LOOK_SCAN shows points' colours alone, clay and occlusion not even those.
[[nodiscard]] bool shows_materials(std::uint32_t look);

/// The settings, with defaults that depend on the scene filled in.
[[nodiscard]] Settings choose_settings(const Scene& scene, const PictureOptions& picture);

}  // namespace splatray
