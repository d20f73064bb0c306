#include "engine/image/picture_error.h"

#include <cmath>

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

std::vector<float> errors_by_part(std::span<const vec4> all, std::span<const vec4> part, double part_samples,
                                  double samples) {
  if (!(samples > part_samples)) return std::vector<float>(all.size(), INFINITY);
  std::vector<float> errors = pixel_errors(all, part);
  // Of independent samples of variance v the change has v (1 / part - 1 / all), the mean v / all.
  const auto scale = static_cast<float>(std::sqrt(part_samples / (samples - part_samples)));
  for (float& error : errors) error *= scale;
  return errors;
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
