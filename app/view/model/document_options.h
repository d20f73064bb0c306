/// What is shown, as the options of splatray-render that make the same picture.
#pragma once
#include "app/cli/options.h"
#include "app/view/model/document.h"

namespace splatray {

/// Options of this picture, `width` x `height` pixels, in ViewMode::shaded; without an output.
[[nodiscard]] RenderOptions render_options(const Document& document, std::uint32_t width,
                                           std::uint32_t height);

struct LoadedScene;

/// The document of a scene that load_scene read without PictureOptions::objects, with the camera, lights, materials and
/// settings that the options ask for. Throws Error (usage) for objects that the scene does not have.
[[nodiscard]] Document first_document(const LoadedScene& loaded, const SceneOptions& scene,
                                      const PictureOptions& picture);

}  // namespace splatray
