/// Takes the noise out of pictures of few samples.
#pragma once
#include <span>

#include "engine/image/image.h"

namespace splatray {

/// The picture without its noise, as an edge-avoiding wavelet filter sees it (Dammertz et al. 2010, "Edge-Avoiding À-Trous
/// Wavelet Transform for fast Global Illumination Filtering"), with the noise known (Schied et al. 2017, "Spatiotemporal
/// Variance-Guided Filtering", sec. 4). Light is filtered, `base` (base colours of the same pixels, rgb linear) is not. Asserts
/// that the image has aov and error.
[[nodiscard]] Image denoised(const Image& image, std::span<const vec4> base);

}  // namespace splatray
