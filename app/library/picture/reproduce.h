/// Pictures that can be made again from what is kept in them.
#pragma once
#include <filesystem>

#include "app/library/shot/shot.h"
#include "engine/scene/scene.h"

namespace splatray {

/// The request of one picture of a shot, seen by `camera`: those of scene, picture, exposure and AOVs, without any file
/// written or compared with.
[[nodiscard]] Request still_request(const Shot& shot, const Camera& camera);

/// The request, its input files spelt in one way.
[[nodiscard]] Request plain_request(Request request);

/// What a picture of splatray-render says was chosen for it (choices_text); empty where it does not say.
[[nodiscard]] std::string kept_choices(const std::filesystem::path& picture);

/// The request kept in a picture of splatray-render, as still_request made them. A relative path of an input that does
/// not exist here is looked for in the picture's folder and those above it. Throws Error (input_unreadable) with path,
/// found and expected.
[[nodiscard]] Request read_picture_request(const std::filesystem::path& picture);

}  // namespace splatray
