/// From a request to the scene that is shown.
#pragma once
#include <functional>
#include <string>

#include "app/library/request/request.h"
#include "engine/scene/environment.h"
#include "preprocess/build.h"

namespace splatray {

/// A scene and how it came to be.
struct LoadedScene {
  Scene scene;
  std::string environment_name;     ///< as choose_environment_name has it
  double load_ms = 0.0;             ///< reading and preprocess
  std::optional<BuildStats> build;  ///< unless read from a .soct
  Request request{};                ///< with what suits the scan where nothing was asked for (suited_picture)
  std::string choices{};            ///< SuitedPicture::choices
  ColorLegend legend{};             ///< of Request::Look::attributes
};

/// Who hears of loading, on its thread; each may be empty.
struct LoadListener {
  Progress progress;  ///< returns false to stop: load_scene then throws Error (interrupted)
  std::function<void(const std::string&)> note;  ///< a sentence about something odd in the files
  PointsListener points{};                       ///< as ReadOptions::points
};

/// Reads or preprocesses the scene; applies --material, --object, --up (else upright of upright.h) and what is shown of
/// attributes. Throws Error, also where the request's region holds nothing of the scene.
[[nodiscard]] LoadedScene load_scene(const Request& request, const LoadListener& listener);

/// The same of objects that are in memory, without what files alone have; their numbers stay. Throws Error.
[[nodiscard]] LoadedScene load_objects(Input input, const Request& request, const LoadListener& listener);

/// What the scene's objects look like with --material and --object. Throws Error (usage).
[[nodiscard]] ObjectLooks choose_objects(const Scene& scene, const Request& request);

/// The tone curve: that of --tone, else Tone::soft with --look paper and Tone::neutral otherwise.
[[nodiscard]] Tone choose_tone(const Request& request);

/// The camera the request asks for: --eye, else the scene's own, else a view of the whole scene.
[[nodiscard]] Camera choose_camera(const Scene& scene, const Request& request);

/// The lights a scene is shown in that nothing else is said of: its own, else the key light of a look (LOOK_*), none
/// where an environment is named.
[[nodiscard]] std::vector<SceneLight> own_lights(const Scene& scene, bool environment_named,
                                                 std::uint32_t look, const Camera& camera);
/// The lights: --light and --sun, else own_lights.
[[nodiscard]] std::vector<SceneLight> choose_lights(const Scene& scene, const Request& request,
                                                    const Camera& camera);

/// The up direction: --up, else the scene's.
[[nodiscard]] glm::dvec3 choose_up(const Scene& scene, const Request& request);
/// The environment's name: --environment, else what the scene names; empty = none.
[[nodiscard]] std::string choose_environment_name(const Scene& scene, const Request& request);

/// The request that makes a light.
[[nodiscard]] LightRequest light_request(const SceneLight& light);

/// The environment of a name that needs no file: white, black, studio, sky:... or r,g,b, empty = studio; nothing for other names.
/// Throws Error (usage) for a radiance that is negative or not finite.
[[nodiscard]] std::optional<Environment> built_in_environment(const std::string& name);
/// The environment `name` of --environment: a file, white, black, studio, r,g,b; empty = studio. `note` hears what is odd about
/// the file. Throws Error (input_unreadable).
[[nodiscard]] Environment choose_environment(const std::string& name,
                                             const std::function<void(const std::string&)>& note = {});

/// The look, LOOK_*: that of --look, else LOOK_SCAN for scans in no light of their own or of the options' and without
/// materials of either, else LOOK_LIT.
[[nodiscard]] std::uint32_t choose_look(const Scene& scene, const Request& request);

/// The settings, with defaults that depend on the scene filled in.
[[nodiscard]] Settings choose_settings(const Scene& scene, const Request& request);

/// Options of which nothing is left open that depends on what a scan is of.
struct SuitedPicture {
  Request request;
  std::string choices;  ///< what was chosen, with the options that say the same; empty for what is no scan
};

/// The picture with what suits the scan (kind_of_scan, with the scene's up direction as it is shown) where nothing is
/// asked for:
/// - view: choose_viewpoint; Settings::cutaway with --view dollhouse, chosen or asked for.
/// - colours: rgb where it says something, else intensity that varies, else none (plain); of sites, sweeps and rooms
///   seen from outside height, and intensity with it.
/// - look: scan where points have colours of their own, whose light is in them, and inside rooms, where little light
///   comes; else lit.
/// Other scenes' options come back as they are, but for cutaway. The scene has its own colours.
[[nodiscard]] SuitedPicture suited_picture(const Scene& scene, const Request& request);

/// Whether a picture for looking at is denoised without being asked for: that of a scan whose look was left open.
[[nodiscard]] bool suits_denoising(const Scene& scene, const Request& asked);
/// Whether the exposure is left to the picture: asked for as auto, or of a scan that nothing is said of.
[[nodiscard]] bool suits_exposure(const Scene& scene, const Request& asked);

}  // namespace splatray
