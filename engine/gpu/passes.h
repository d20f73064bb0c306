/// Samples added to the tiles of an image, a pass over all of them at a time.
#pragma once
#include <functional>
#include <span>
#include <vector>

#include "engine/gpu/runner.h"
#include "engine/image/sample_mean.h"

namespace splatray {

/// The means of some tiles' pixels, which all have the same number of samples, whenever they are looked at.
class Passes {
 public:
  /// Called with the samples that a dispatch added to all of a tile's pixels together; may throw to end the pass.
  using Advance = std::function<void(std::uint64_t samples)>;

  /// `tiles` must outlive it, and fit the runner's accumulation buffer one by one. The first pass has `first` samples, later ones
  /// what about a second is enough for.
  Passes(Runner& runner, const Dispatch& dispatch, std::span<const Tile> tiles, std::uint32_t first);

  /// Adds samples to every pixel, so that each has at most `end`. Where `advance` throws, all pixels stay as they were. Throws
  /// Error (failed) where the driver cuts a single ray's loops.
  void add(std::uint32_t end, const Advance& advance);
  [[nodiscard]] std::uint32_t samples() const { return before_.samples() + in_block_; }  ///< in each pixel
  /// Means of each pixel of the tiles, one tile behind the other, of at least one sample; with OUTPUT_BASE a tile's base colours
  /// stand behind its radiance.
  [[nodiscard]] std::vector<vec4> means() const;
  [[nodiscard]] double trace_ms() const { return trace_ms_; }  ///< of all dispatches

 private:
  [[nodiscard]] bool trace(const Tile& tile, std::span<vec4> means, std::uint32_t end,
                           const Advance& advance);

  Runner& runner_;
  const Dispatch& dispatch_;
  const std::size_t values_;  ///< means of a pixel
  const std::span<const Tile> tiles_;
  ThreadWork work_;
  SampleMean before_;           ///< of whole blocks
  std::vector<vec4> block_;     ///< means of the samples behind those
  std::uint32_t in_block_ = 0;  ///< how many those are
  std::uint32_t pass_;          ///< samples of the next pass
  double trace_ms_ = 0.0;
};

/// Reads the means of a tile back; false where a driver cut some pixel's loops.
[[nodiscard]] bool read_means(Runner& runner, const Buffer& accumulation, std::span<vec4> means);

/// Adds samples [begin, end) to a tile's means, whose buffer is bound, `batch` of them first and then as many as `batch` is made;
/// `advance` hears of each batch. Returns the device's milliseconds.
double trace_samples(Runner& runner, TileDispatch& tile, std::uint32_t begin, std::uint32_t end,
                     const ThreadWork& work, std::uint32_t& batch,
                     const std::function<void(std::uint32_t)>& advance);

/// Throws Error (failed): the driver cuts a single ray's loops.
[[noreturn]] void refuse_cut_loops();

}  // namespace splatray
