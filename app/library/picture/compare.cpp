#include "app/library/picture/compare.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>

namespace splatray {

Comparison compare(const DisplayImage& picture, const DisplayImage& reference, const Tolerance& tolerance) {
  assert(picture.width == reference.width && picture.height == reference.height);
  constexpr float VISIBLE = 10.0F;
  Comparison result;
  result.difference = {picture.width, picture.height, {}};
  std::size_t beyond = 0;
  double squares = 0.0;
  for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
    const vec3 difference = glm::abs(picture.rgb[i] - reference.rgb[i]);
    const double error = std::max({difference.x, difference.y, difference.z});
    if (error > tolerance.threshold) ++beyond;
    result.worst = std::max(result.worst, error);
    squares += glm::dot(difference, difference);
    result.difference.rgb.push_back(glm::min(difference * VISIBLE, 1.0F));
  }
  const auto pixels = static_cast<double>(picture.rgb.size());
  result.share = static_cast<double>(beyond) / pixels;
  result.psnr_db = -10.0 * std::log10(squares / (3.0 * pixels));
  result.passed = result.share <= tolerance.share && result.worst <= tolerance.limit;
  return result;
}

std::string describe(const Comparison& comparison, const Tolerance& tolerance) {
  char text[256];
  std::snprintf(
      text, sizeof text,
      "%.4g %% of pixels beyond %.3g (allowed %.3g %%), largest error %.4f (allowed %.3g), PSNR %.1f dB",
      100.0 * comparison.share, tolerance.threshold, 100.0 * tolerance.share, comparison.worst,
      tolerance.limit, comparison.psnr_db);
  return text;
}

}  // namespace splatray
