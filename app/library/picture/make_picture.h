/// The one way from a shot and a scene on a device to a picture.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "app/library/shot/scene_on_device.h"
#include "app/library/shot/shot.h"

namespace splatray {

/// A picture and what is known of it.
struct MadePicture {
  Image image;
  RenderStats stats;
  std::size_t lights = 0;
  std::vector<std::string> notes;  ///< sentences about its light
  std::string denoiser;            ///< which took the noise out; empty where none did
  double denoise_ms = 0.0;         ///< 0 where none did
  /// Samples a pixel that were asked for and not made, as it was stopped and kept; then no denoiser had it.
  std::uint32_t samples_missing = 0;
  std::optional<Sheet> sheet{};  ///< the drawing with its lines, of a sheet that has them as curves
  std::string devices;           ///< that made its samples, as picture_metadata names them
};

/// The shot's picture from a camera, in its lights (picture_lights.h): by samples or until it is good enough, from those of --resume
/// on, and without noise, as it says. Throws Error: usage, input_unreadable, failed, interrupted when `progress` says so and it is not
/// kept; a picture that is traced until it is good enough never is. For --xray the scene has its pools.
[[nodiscard]] MadePicture make_picture(const Shot& shot, SceneOnDevice& shown, const Camera& camera,
                                       const Tracer::Progress& progress, Stopped stopped = Stopped::dropped);

}  // namespace splatray
