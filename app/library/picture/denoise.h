/// --denoise: pictures of few samples without their noise.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "engine/gpu/tracer.h"

namespace splatray {

/// Base colours of the pixels of a picture that the tracer makes of this look and view with these settings, which guide a filter; of looks
/// that have one for all, white. Throws Error (interrupted) where `progress` stops it.
[[nodiscard]] std::vector<vec4> base_colors(Tracer& tracer, const Look& look, const View& view,
                                            const Settings& settings, const Tracer::Progress& progress = {});

/// Settings of the picture that base_colors traces; nothing where all are white.
[[nodiscard]] std::optional<Settings> base_settings(const Settings& settings);

/// Whether remove_noise uses our own filter.
[[nodiscard]] bool has_own_filter();

/// Takes the noise out of a picture, which has aov and part, and these base colours: by Open Image Denoise 2 where that is installed,
/// else by our own filter (engine/image/denoise.h). A part of a picture is filtered by what it shows alone: near its edges it may
/// differ from the whole picture's. Returns which, in the words that the user reads. Throws Error (failed) with Open Image Denoise's own
/// words. Needs no device: any thread may call it.
[[nodiscard]] std::string remove_noise(Image& image, std::vector<vec4> base);

}  // namespace splatray
