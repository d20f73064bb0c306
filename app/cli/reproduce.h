/// Pictures that can be made again from what is kept in them.
#pragma once
#include <filesystem>

#include "app/cli/options.h"
#include "engine/scene/scene.h"

namespace splatray {

/// The options that make one picture, seen by `camera`: those of scene, picture, exposure and AOVs, without any file
/// written or compared with.
[[nodiscard]] RenderOptions still_options(const RenderOptions& options, const Camera& camera);

/// The options kept in a picture of splatray-render, as still_options made them. A relative path of an input that does
/// not exist here is looked for in the picture's folder and those above it. Throws Error (input_unreadable) with path,
/// found and expected.
[[nodiscard]] RenderOptions read_picture_options(const std::filesystem::path& picture);

}  // namespace splatray
