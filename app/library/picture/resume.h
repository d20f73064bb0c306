/// --resume: more samples for a picture that has some.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "app/library/shot/shot.h"
#include "engine/gpu/tracer.h"

namespace splatray {

/// The samples that a picture has already.
struct StartedPicture {
  std::vector<vec4> means;
  std::uint32_t samples;  ///< of each pixel, the first ones
  std::string devices;    ///< that made them, as picture_metadata names one
};

/// The samples of the EXR that --resume names; nothing without the option. Throws Error (input_unreadable) with path, found and
/// expected for what splatray-render did not write, or with other options that decide a sample's light, another camera, or a
/// scene of another size, and where it has all samples that are asked for; of another device or driver than this one, whose
/// samples may differ, unless that is allowed.
[[nodiscard]] std::optional<StartedPicture> read_started(const Shot& shot, const Scene& scene,
                                                         const Camera& camera, const Device& device);

/// Adds them to an image of the samples behind them, and to its statistics; `estimate_error`: also its error.
void add_started(const StartedPicture& started, bool estimate_error, Image& image, RenderStats& stats);

}  // namespace splatray
