#include "preprocess/read/scan/stored_colors.h"

#include <algorithm>
#include <cmath>

#include "engine/base/release.h"

namespace splatray {

std::string store_colors(std::array<std::vector<float>, 3> channels, Points& points) {
  float most = 0.0F;
  bool whole = true;
  for (const std::vector<float>& channel : channels)
    for (const float value : channel) {
      if (!std::isfinite(value)) continue;
      most = std::max(most, value);
      whole = whole && value == std::floor(value);
    }
  const bool as_stored = whole && most != 1.0F;
  const float full = most <= 1.0F ? 1.0F : most <= 255.0F ? 255.0F : 65535.0F;
  const double scale = as_stored ? 1.0 : 65535.0 / static_cast<double>(full);
  points.stored_color.resize(channels[0].size());
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<float>& channel = channels[static_cast<std::size_t>(axis)];
    for (std::size_t i = 0; i < channel.size(); ++i)
      points.stored_color[i][axis] = stored_channel(scale * static_cast<double>(channel[i]));
    release(channel);
  }
  points.stored_color_most = as_stored ? 0 : 65535;
  return as_stored ? "" : "colours are taken as of 0 to " + std::to_string(static_cast<int>(full));
}

}  // namespace splatray
