/// The one way from a request and a scene on a device to a picture.
#pragma once
#include <string>
#include <vector>

#include "app/library/picture/scene_on_device.h"
#include "app/library/request/request.h"

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
  std::string devices;  ///< that made its samples, as picture_metadata names them
};

/// The picture in the lights that the request asks for, or where it asks for none and none enters in that of the camera
/// (eye_light.h): by samples or until it is good enough, from those of --resume on, and without noise, as it says. Throws Error:
/// usage, input_unreadable, failed, interrupted when `progress` says so and it is not kept; a picture that is traced until it is
/// good enough never is.
[[nodiscard]] MadePicture make_picture(const Request& request, SceneOnDevice& shown, const Camera& camera,
                                       const Tracer::Progress& progress, Stopped stopped = Stopped::dropped);

/// The exposure, stops in hundredths, that automatic_exposure_ev gives a small picture of the whole view, at most 160 pixels wide
/// and high. Parts of a picture, and all pictures of a run, have one exposure by it.
[[nodiscard]] double preview_exposure_ev(const Request& request, SceneOnDevice& shown, const Camera& camera);

}  // namespace splatray
