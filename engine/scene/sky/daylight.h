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

/// Lumens of a watt of daylight's radiances: that of light which is alike at all visible wavelengths (Ward 1994, "The RADIANCE
/// Lighting Simulation and Rendering System"). Luminance, cd/m2, is 179 times 0.2126 r + 0.7152 g + 0.0722 b.
inline constexpr double DAYLIGHT_LUMENS_PER_WATT = 179.0;

/// 1024 x 512 texels of the sky's radiance, W/m2/sr, linear sRGB, the sun among them, over a grey ground that reflects a fifth of
/// their light. The sky: Hosek and Wilkie 2012, "An Analytic Model for Full Spectral Sky-Dome Radiance", over black ground, in CIE
/// XYZ; the sun's disc: Hosek and Wilkie 2013, "Adding a Solar Radiance Function to the Hosek Skylight Model".
[[nodiscard]] Environment daylight_environment(const Daylight& daylight);

}  // namespace splatray
