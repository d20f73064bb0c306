/// The one way from a request and a scene on a device to a picture.
#pragma once
#include <string>

#include "app/library/request/request.h"
#include "engine/gpu/tracer.h"

namespace splatray {

/// A picture and what is known of it.
struct MadePicture {
  Image image;
  RenderStats stats;
  std::size_t lights = 0;
  std::string denoiser;     ///< which took the noise out; empty where none did
  double denoise_ms = 0.0;  ///< 0 where none did
};

/// The picture of the scene that the tracer shows, with the scene's materials and the environment that the request asks for; sets the
/// lights. Of the scene only what is small is looked at: the pools may be gone. By samples or until it is good enough, and without
/// noise, as the request says. Throws Error: usage, interrupted when `progress` says so, failed.
[[nodiscard]] MadePicture make_picture(const Request& request, const Scene& scene, const Camera& camera,
                                       Tracer& tracer, const Tracer::Progress& progress);

}  // namespace splatray
