/// --denoise: pictures of few samples without their noise.
#pragma once
#include <string>

#include "engine/gpu/tracer.h"

namespace splatray {

/// Takes the noise out of a picture that the tracer made of this look and view with these settings, which have aov and
/// estimate_error: by Open Image Denoise 2 where that is installed, else by our own filter (engine/image/denoise.h). A
/// part of a picture is filtered by what it shows alone: near its edges it may differ from the whole picture's. Returns which, in the
/// words that the user reads. Throws Error (failed) with Open Image Denoise's own words.
[[nodiscard]] std::string remove_noise(Tracer& tracer, const Look& look, const View& view,
                                       const Settings& settings, Image& image);

}  // namespace splatray
