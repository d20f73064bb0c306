/// What the points of a scan in levels that were not read change in a picture of it, by a sample of the picture.
#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "app/library/shot/scene_on_device.h"
#include "app/library/shot/scene_source.h"
#include "app/library/shot/shot.h"

namespace splatray {

/// What is found in one part of a picture: sums over its pixels and channels of the radiance with the points read and with all, and of
/// the squared difference of their display values, without the noise of either picture.
struct LodErrorPart {
  double radiance = 0.0, radiance_of_all = 0.0, squares = 0.0;
  std::size_t values = 0;
};

/// A figure of the whole picture, and where it lies with 95 %.
struct LodErrorFigure {
  double value = 0.0, low = 0.0, high = 0.0;
};

struct LodError {
  LodErrorFigure bias;     ///< of the picture's mean radiance, as a share of that with all points
  LodErrorFigure psnr_db;  ///< of display values, peak 1; +inf where no difference is found
};

/// That of which these parts, of which there are at least 2, are a sample: ratios of sums (Cochran 1977, Sampling Techniques, section 6)
/// with Student's distribution.
[[nodiscard]] LodError lod_error_of(const std::vector<LodErrorPart>& parts);

/// "mean +0.42 % (+0.20 to +0.64), PSNR 31.2 dB (30.1 to 32.6)", and what that is.
[[nodiscard]] std::string lod_error_text(const LodError& error);

/// The parts of a picture, or of its window: one of 32 x 32 pixels at a place by chance, of the seed, in each of 5 x 4 equal fields.
[[nodiscard]] std::vector<PixelWindow> lod_error_windows(const PixelWindow& made, std::uint32_t seed);

/// Where the request asks for it, finds the error of the shot's first picture, keeps it as the shot's lod_error and tells `note`: the
/// parts are traced from the scene shown and from one that has all points in sight of them, twice each, with other samples. Around the
/// parts the points are as in the picture, which sends light and shadows into them. Nothing is said of views that leave out walls by
/// their sides: of vaulted_room two of four samples found +20 and +40 % where +0.2 % was right, as a wall had its other side. Throws
/// Error.
void measure_lod_error(Shot& shot, SceneOnDevice& shown, const LoadedScene& loaded,
                       const std::function<void(const std::string&)>& note);

}  // namespace splatray
