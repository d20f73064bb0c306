/// How far a picture is from the truth.
#pragma once
#include "engine/image/image.h"
#include "engine/image/view.h"
#include "tests/bench/cases/wilson.h"
#include "tests/bench/truth/truth.h"

namespace splatray::testing {

/// NaN where nothing was measured. Depths and normals are compared where both the picture and the truth show a surface.
struct Errors {
  double mismatch_ppm = NAN;         ///< pixels that hit in one and miss in the other / all pixels
  double mismatch_edge_ppm = NAN;    ///< of these those on true silhouettes (TruePixel::edge) / all pixels
  double mismatch_inside_ppm = NAN;  ///< and the others / all pixels
  /// Picture - truth, of pixels off silhouettes; in units of the scene's diagonal.
  double depth_signed_mean = NAN;
  double depth_abs_median = NAN;  ///< of all pixels compared
  double depth_abs_p99 = NAN;
  double normal_median_deg = NAN;  ///< angle between the normals, degrees
  double normal_p95_deg = NAN;
  double normal_p99_deg = NAN;
  double normal_rms_deg = NAN;
  Share holes;  ///< pixels off silhouettes where the picture misses the surface or shows one behind it
  std::uint64_t hole_rays = 0;  ///< pixels that `holes` is a share of; 0 = not measured
  double psnr_db = NAN;         ///< of both shaded in one light (shading.h); +inf = equal
  double flip_mean = NAN;       ///< likewise
};

/// Compares Image::aov of a picture of `view` with the truth of the same view. A hole shows a surface more than
/// Truth::jump_world behind the true one, or none.
[[nodiscard]] Errors errors_of(const Image& image, const Truth& truth, const View& view,
                               double diagonal_world);

}  // namespace splatray::testing
