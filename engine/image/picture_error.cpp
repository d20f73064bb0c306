#include "engine/image/picture_error.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace splatray {

std::vector<float> pixel_errors(std::span<const vec4> a, std::span<const vec4> b) {
  std::vector<float> errors;
  errors.reserve(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    const vec3 apart(a[i] - b[i]);
    errors.push_back(std::sqrt(glm::dot(apart, apart) / 3.0F));
  }
  return errors;
}

void estimate_errors(std::vector<vec4> part, double part_samples, double samples, Image& image) {
  image.part = std::move(part);
  image.part_share = static_cast<float>(std::min(part_samples / samples, 1.0));
  image.error.assign(image.rgba.size(), INFINITY);
  if (!(samples > part_samples)) return;
  image.error = pixel_errors(image.rgba, image.part);
  // For independent samples of variance v the change has the variance v (1 / part - 1 / all), the mean v / all.
  const auto scale = static_cast<float>(std::sqrt(part_samples / (samples - part_samples)));
  for (float& error : image.error) error *= scale;
}

double mean_radiance(std::span<const vec4> pixels) {
  double sum = 0.0;
  for (const vec4& pixel : pixels) sum += (double(pixel.x) + double(pixel.y) + double(pixel.z)) / 3.0;
  return pixels.empty() ? 0.0 : sum / static_cast<double>(pixels.size());
}

double relative_error(const Image& image) {
  double squares = 0.0;
  for (const float error : image.error) squares += double(error) * double(error);
  const double mean = mean_radiance(image.rgba);
  return mean > 0.0 ? std::sqrt(squares / static_cast<double>(image.error.size())) / mean : 0.0;
}

}  // namespace splatray
