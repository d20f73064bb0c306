/// Takes the noise out of pictures of few samples.
#pragma once
#include <span>

#include "engine/image/image.h"

namespace splatray {

/// The picture without its noise, as an edge-avoiding wavelet filter sees it (Dammertz et al. 2010, "Edge-Avoiding À-Trous
/// Wavelet Transform for fast Global Illumination Filtering"), guided by normals, depths, and the noise that two independent
/// pictures show (Image::part): what is averaged of one is what the other finds alike beyond its noise (Rousselle et al. 2012,
/// "Adaptive Rendering with Non-Local Means Filtering", sec. 4). What is bright by chance in one of the two alone loses light.
/// Light is filtered, `base` (base colours of the same pixels, rgb linear) is not. Asserts that the image has aov and part.
[[nodiscard]] Image denoised(Image image, std::span<const vec4> base);

}  // namespace splatray
