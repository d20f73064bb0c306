/// The sky and the sun of a clear or hazy day.
#pragma once
#include "engine/scene/environment.h"

namespace splatray {

struct Daylight {
  /// Above the horizon, more than 0 up to 90.
  double sun_elevation_deg = 40.0;
  /// Clockwise from the environment's -z, seen from above: from north where that is the world's +y.
  double sun_azimuth_deg = 135.0;
  /// Haze, 2 (clear) to 10 (hazy).
  double turbidity = 3.0;
};

/// 1024 x 512 texels of the sky's radiance, the sun among them, over a grey ground that reflects a fifth of their light:
/// Preetham, Shirley and Smits 1999, "A Practical Analytic Model for Daylight", appendix A.2 (sky), A.1 (sunlight at 610, 550 and
/// 465 nm). As bright as makes the irradiance of a level surface pi, in luminance: white ground then sends out 1.
[[nodiscard]] Environment daylight_environment(const Daylight& daylight);

}  // namespace splatray
