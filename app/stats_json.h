/// What a render did, as JSON for people and scripts.
#pragma once
#include <filesystem>

#include "app/scene_source.h"
#include "engine/gpu/tracer.h"

namespace splatray {

/// Times of the program's own stages, milliseconds.
struct StageTimes {
  double device_ms = 0.0, upload_ms = 0.0, write_ms = 0.0;
};

/// Writes the file: device, scene, picture, times per stage, bytes per pool, and rays by class, steps and
/// tests when counted. Throws Error (failed); leaves no partial file.
void write_stats(const std::filesystem::path& path, const LoadedScene& loaded, const View& view,
                 const Settings& settings, const Context& context, const Tracer& tracer,
                 const StageTimes& times);

}  // namespace splatray
