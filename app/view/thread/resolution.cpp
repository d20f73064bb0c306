#include "app/view/thread/resolution.h"

#include <algorithm>
#include <cmath>

namespace splatray {

double MovingResolution::scale(glm::uvec2 window_px, double wanted_ms, double most_ms) {
  constexpr double LEAST = 1.0 / 16.0, ENOUGH = 1.0 / 3.0, STEP = 1.125;
  const double pixels = double(window_px.x) * window_px.y;
  const auto of_ms = [&](double ms) { return std::sqrt(ms / (ms_per_pixel_ * pixels)); };
  const double wanted = std::clamp(std::max(of_ms(wanted_ms), std::min(ENOUGH, of_ms(most_ms))), LEAST, 1.0);
  const bool close = wanted < scale_ * STEP && wanted > scale_ / STEP && (wanted < 1.0 || scale_ == 1.0);
  if (!close) scale_ = wanted;
  return scale_;
}

void MovingResolution::learn(double pixels, double ms) {
  constexpr double MOST_CHANGE = 2.0;
  const double ratio = ms / pixels / ms_per_pixel_;
  ms_per_pixel_ *= std::clamp(ratio, 1.0 / MOST_CHANGE, MOST_CHANGE);
}

glm::uvec2 scaled_size(glm::uvec2 window_px, double scale) {
  return glm::max(glm::uvec2(glm::round(glm::dvec2(window_px) * scale)), glm::uvec2(1));
}

}  // namespace splatray
