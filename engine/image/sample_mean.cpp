#include "engine/image/sample_mean.h"

#include <bit>

namespace splatray {
namespace {

/// The mean of two ranges: products are exact, so that contracted operations round no differently.
vec4 joined(const vec4& a, std::uint32_t samples_a, const vec4& b, std::uint32_t samples_b) {
  const double all = double(samples_a) + samples_b;
  return vec4((double(samples_a) * glm::dvec4(a) + double(samples_b) * glm::dvec4(b)) / all);
}

}  // namespace

std::uint32_t whole_range(std::uint32_t samples) {
  return BLOCK_SAMPLES * std::bit_ceil((samples + BLOCK_SAMPLES - 1) / BLOCK_SAMPLES);
}

std::uint64_t range_bytes(std::uint32_t samples) {
  return (1U + std::bit_width(samples / BLOCK_SAMPLES)) * sizeof(vec4);
}

void SampleMean::add(std::vector<vec4> means, std::uint32_t samples) {
  for (; !ranges_.empty() && ranges_.back().samples == samples; samples *= 2) {
    for (std::size_t i = 0; i < means.size(); ++i)
      means[i] = joined(ranges_.back().means[i], samples, means[i], samples);
    ranges_.pop_back();
  }
  ranges_.push_back({std::move(means), samples});
}

std::uint32_t SampleMean::samples() const {
  std::uint32_t sum = 0;
  for (const Range& range : ranges_) sum += range.samples;
  return sum;
}

void SampleMean::join(std::span<vec4> last, std::size_t first, std::uint32_t samples) const {
  for (auto range = ranges_.rbegin(); range != ranges_.rend(); ++range) {
    for (std::size_t i = 0; i < last.size(); ++i)
      last[i] = joined(range->means[first + i], range->samples, last[i], samples);
    samples += range->samples;
  }
}

}  // namespace splatray
