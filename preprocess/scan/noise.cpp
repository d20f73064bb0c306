#include "preprocess/scan/noise.h"

#include <cmath>
#include <functional>

#include "preprocess/base/parallel.h"
#include "preprocess/base/select.h"

namespace splatray {
namespace {

constexpr float ALIKE = 0.9F;               // cosine of normals of one smooth surface
constexpr std::size_t MOST_ASKED = 200000;  // points that tell the median well enough

/// What a point and its nearest places disagree about.
float disagreement(const Cloud& cloud, const Survey& survey, std::uint32_t i) {
  float sum = 0.0F, count = 0.0F;
  for (const std::uint32_t j : survey.around(i).first(Survey::RING)) {
    const float along = glm::dot(cloud.normal[i], cloud.normal[j]);
    if (std::abs(along) < ALIKE) continue;
    const glm::vec3 both = cloud.normal[i] + std::copysign(1.0F, along) * cloud.normal[j];
    const float height = 0.5F * glm::dot(both, cloud.coord[j] - cloud.coord[i]);
    sum += height * height;
    count += 1.0F;
  }
  return count > 0.0F && survey.reach[i] > 0.0F ? std::sqrt(sum / count) / survey.reach[i] : 0.0F;
}

/// The median over at most about `most` of the points.
template <typename NoiseOf>
double median(const std::vector<std::uint32_t>& points, std::size_t most, const NoiseOf& noise_of) {
  const std::size_t stride = points.size() / most + 1;
  std::vector<float> noise(points.size() / stride);
  tbb::parallel_for(std::size_t{0}, noise.size(),
                    [&](std::size_t n) { noise[n] = noise_of(points[n * stride]); });
  if (noise.empty()) return 0.0;
  select_nth(std::span(noise), noise.size() / 2, std::identity());
  return noise[noise.size() / 2];
}

}  // namespace

double measure_noise(const Cloud& cloud, const Survey& survey) {
  const auto points = numbers_where(cloud.size(), [&](std::size_t i) { return survey.estimated[i] != 0; });
  return median(points, MOST_ASKED, [&](auto i) { return disagreement(cloud, survey, i); });
}

}  // namespace splatray
