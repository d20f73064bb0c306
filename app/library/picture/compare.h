/// The difference between two pictures in three numbers.
#pragma once
#include <string>

#include "app/library/display_image.h"

namespace splatray {

/// What a comparison allows. A pixel's error is its largest channel difference of display-encoded values,
/// 0..1.
struct Tolerance {
  double threshold = 0.004;  ///< errors up to here do not count
  double share = 0.0002;     ///< share of pixels that may exceed the threshold
  double limit = 0.012;      ///< no pixel may exceed this
};

struct Comparison {
  double share = 0.0;    ///< pixels beyond the threshold / all pixels
  double worst = 0.0;    ///< largest error of a pixel
  double psnr_db = 0.0;  ///< of all channels, peak 1; +inf for equal pictures
  bool passed = false;
  DisplayImage difference;  ///< absolute differences, times 10, clipped
};

/// Compares two pictures of the same size (asserted).
[[nodiscard]] Comparison compare(const DisplayImage& picture, const DisplayImage& reference,
                                 const Tolerance& tolerance);

/// The numbers and what was allowed, as part of a sentence.
[[nodiscard]] std::string describe(const Comparison& comparison, const Tolerance& tolerance);

}  // namespace splatray
