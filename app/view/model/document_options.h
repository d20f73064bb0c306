/// What is shown, as the options of splatray-render that make the same picture.
#pragma once
#include "app/cli/options.h"
#include "app/view/model/document.h"
#include "app/view/model/scene_files.h"

namespace splatray {

/// Options of this picture, `width` x `height` pixels, in ViewMode::shaded; without an output.
[[nodiscard]] RenderOptions render_options(const Document& document, std::uint32_t width,
                                           std::uint32_t height);

/// The document of a scene that load_scene read without PictureOptions::objects, with the camera, lights, materials and
/// settings that the options ask for. Throws Error (usage) for objects that the scene does not have.
[[nodiscard]] Document first_document(const Scene& scene, const SceneOptions& source,
                                      const PictureOptions& picture);

/// Whether the document's scene is the one of these options, so that they change the look alone.
[[nodiscard]] bool is_of_scene(const Document& document, const RenderOptions& options);
/// The document of the same scene, shown as the options ask for. Throws as first_document.
[[nodiscard]] Document shown_as(const Scene& scene, const Document& document, const PictureOptions& picture);

/// What is kept of a picture when another scene is opened: what is no scene's own.
[[nodiscard]] PictureOptions kept_options(const Document& document);
/// The options that load the document's scene with more files and show it as it is shown.
[[nodiscard]] RenderOptions options_with(const Document& document, const SceneFiles& more);

}  // namespace splatray
