#include "app/view/display/moving_picture.h"

#include <algorithm>
#include <array>

#include "app/view/display/eye_dome.h"
#include "engine/base/srgb.h"

namespace splatray {
namespace {

constexpr double MOST_GAIN = 4.0;  ///< and its inverse: beyond, the picture at rest shows something else

float brightness(const vec3& linear) { return 0.2126F * linear.x + 0.7152F * linear.y + 0.0722F * linear.z; }

/// Mean of the pixels that show something; nothing where none does.
template <class Linear>
std::optional<double> mean_brightness(const Image& image, const Linear& linear) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < image.rgba.size(); ++i) {
    if (!(image.rgba[i].w > 0.0F)) continue;
    sum += brightness(linear(i));
    ++count;
  }
  if (count == 0) return {};
  return sum / static_cast<double>(count);
}

}  // namespace

void MovingPicture::rest(const Image& image, const std::vector<std::uint8_t>& display) {
  static const std::array<float, 256> LINEAR = [] {
    std::array<float, 256> linear{};
    for (std::size_t i = 0; i < linear.size(); ++i)
      linear[i] = srgb_to_linear(static_cast<float>(i) / 255.0F);
    return linear;
  }();
  rest_ = mean_brightness(image, [&display](std::size_t i) {
    return vec3(LINEAR[display[4 * i]], LINEAR[display[4 * i + 1]], LINEAR[display[4 * i + 2]]);
  });
}

std::vector<std::uint8_t> MovingPicture::display(const Image& image, const View& view, double strength,
                                                 const DisplayTable& table) {
  static const DisplayTable AS_IT_IS{Display(0.0, Tone::none)};
  std::vector<float> distance(image.rgba.size());
  std::transform(image.rgba.begin(), image.rgba.end(), distance.begin(),
                 [](const vec4& pixel) { return pixel.w; });
  const std::vector<float> shade = eye_dome(distance, view, strength);
  const auto shaded = [&](std::size_t i) { return vec3(image.rgba[i]) * shade[i]; };
  if (rest_) {
    const double now = mean_brightness(image, shaded).value_or(0.0);
    if (now > 0.0) gain_ = static_cast<float>(std::clamp(*rest_ / now, 1.0 / MOST_GAIN, MOST_GAIN));
    rest_.reset();
  }
  std::vector<vec4> colors = image.rgba;
  for (std::size_t i = 0; i < colors.size(); ++i)
    if (colors[i].w > 0.0F) colors[i] = vec4(gain_ * shaded(i), 1.0F);
  std::vector<std::uint8_t> bytes = table.rgba(colors);
  for (std::size_t i = 0; i < colors.size(); ++i)
    if (image.rgba[i].w > 0.0F)
      for (int channel = 0; channel < 3; ++channel)
        bytes[4 * i + static_cast<std::size_t>(channel)] = AS_IT_IS(colors[i][channel]);
  return bytes;
}

}  // namespace splatray
