/// What is shown, as the request that makes the same picture.
#pragma once
#include "app/library/shot/shot.h"
#include "app/view/model/document.h"
#include "app/view/model/scene_files.h"

namespace splatray {

/// Lights that have all that they need, as requests for them.
[[nodiscard]] std::vector<LightRequest> requested_lights(const std::vector<SceneLight>& lights);

/// The request of this picture, `width` x `height` pixels, in ViewMode::shaded; without an output.
[[nodiscard]] Request request_of(const Document& document, std::uint32_t width, std::uint32_t height);

/// The request of a picture or pictures of the document that are saved. Of `asked` count size, part, samples or goal, denoising and
/// output (OF_FILES), or the sheet, of which the document gives all but the camera.
[[nodiscard]] Request saved_request(const Document& document, const Request& asked);

/// The document of a scene that load_scene read without the objects and attributes of the look: the shot of the request, whose camera,
/// lights, materials and settings it has. `facts`: of the scene. Throws Error (usage) for objects that the scene does not have.
[[nodiscard]] Document first_document(const Scene& scene, const SceneFacts& facts, const Request& asked);
/// The same of that shot.
[[nodiscard]] Document first_document(const Scene& scene, const SceneFacts& facts, const Request& asked,
                                      const Shot& shot);

/// Whether the document's scene is the one of this request, so that it changes the look alone.
[[nodiscard]] bool is_of_scene(const Document& document, const Request& request);
/// The document of the same scene, shown as the request asks for. Throws as first_document.
[[nodiscard]] Document shown_as(const Scene& scene, const Document& document, const Request& asked);

/// Shows a light at the camera, which is then that of the scene as it was loaded, instead of those that it was given.
void show_light_at_camera(const SceneLight& light, Document& document);

/// Shows other surroundings, and them behind the scene where a background was chosen, not asked for.
void show_environment(const std::string& environment, Document& document);

/// What is kept of a picture when another scene is opened: what is no scene's own.
[[nodiscard]] Request kept_request(const Document& document);
/// The request that loads the document's scene with more files and shows it as it is shown.
[[nodiscard]] Request request_with(const Document& document, const SceneFiles& more);

}  // namespace splatray
