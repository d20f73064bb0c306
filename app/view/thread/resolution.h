/// How finely a picture is traced while it moves.
#pragma once
#include <glm/glm.hpp>

namespace splatray {

/// Learns how long a pixel takes, and chooses the size that takes the wanted time.
class MovingResolution {
 public:
  /// Traced pixels per window pixel along an edge, 1/16 to 1: those of `wanted_ms`, but where these are less than a third of the
  /// window, of up to `most_ms`. Changes only by an eighth and more, so that the picture does not flicker.
  [[nodiscard]] double scale(glm::uvec2 window_px, double wanted_ms, double most_ms = 0.0);
  /// A picture of `pixels` took `ms`. One outlier at most halves or doubles what is believed.
  void learn(double pixels, double ms);

 private:
  double ms_per_pixel_ = 0.002;  ///< half a million pixels a second
  double scale_ = 0.0;           ///< the last one; 0 = none
};

/// The size in pixels at a scale, at least 1 x 1.
[[nodiscard]] glm::uvec2 scaled_size(glm::uvec2 window_px, double scale);

}  // namespace splatray
