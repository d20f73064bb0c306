/// Takes the noise out of pictures of few samples.
#pragma once
#include <span>
#include <vector>

#include "engine/image/image.h"

namespace splatray {

/// Makes a picture with aov and part, and the base colours of its pixels, fit for filters: a pixel that is not finite becomes the mean
/// of the finite ones of the 3 x 3 around it (0 without any), radiance is limited to 1e15, base colours to 0..1. A pixel whose normal
/// or depth is not finite becomes a miss.
void make_finite(Image& image, std::span<vec4> base);

/// The picture without its noise, as an edge-avoiding wavelet filter sees it (Dammertz et al. 2010, "Edge-Avoiding À-Trous
/// Wavelet Transform for fast Global Illumination Filtering"), guided by normals, depths, and the noise that two independent
/// pictures show (Image::part): each half is filtered with weights taken from the other (Rousselle et al. 2012,
/// "Adaptive Rendering with Non-Local Means Filtering", sec. 4). Pixels that are bright by chance in one of the two alone give light to
/// the surface around them. Light over `base` (base colours of the same pixels, rgb linear) is filtered, among pixels of like base
/// colours. Both go through make_finite first, and the picture stays finite. Asserts that the image has aov and part.
[[nodiscard]] Image denoised(Image image, std::vector<vec4> base);

}  // namespace splatray
