/// The mean of a picture's samples, of which ranges may be made apart (Settings::sample_offset).
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "shaders/layout.h"

namespace splatray {

/// Samples of a pixel whose mean runs on the device, one after the other; more are joined by SampleMean.
inline constexpr std::uint32_t BLOCK_SAMPLES = 64;

/// Samples of the smallest whole range, BLOCK_SAMPLES times a power of two, that has room for `samples`.
[[nodiscard]] std::uint32_t whole_range(std::uint32_t samples);

/// Bytes a pixel that a SampleMean of up to `samples` samples takes, and the block behind it, at most.
[[nodiscard]] std::uint64_t range_bytes(std::uint32_t samples);

/// The means of a picture's pixels over more and more of its samples. Two whole ranges of the same length that make one twice as
/// long are joined, always the same two, in float64: which bits come out does not depend on who made which range. Pairs also lose
/// less to rounding than a sum that runs (Higham 1993, "The Accuracy of Floating Point Summation").
class SampleMean {
 public:
  /// Adds the next samples' means: of a whole range that begins at a multiple of its length.
  void add(std::vector<vec4> means, std::uint32_t samples);
  /// How many were added.
  [[nodiscard]] std::uint32_t samples() const;
  /// Makes `last`, the means of any `samples` further ones of the pixels from `first` on, the means of all.
  void join(std::span<vec4> last, std::size_t first, std::uint32_t samples) const;

 private:
  struct Range {
    std::vector<vec4> means;
    std::uint32_t samples;
  };
  std::vector<Range> ranges_;  ///< each shorter than the one before
};

}  // namespace splatray
