/// What the parts of Tracer share: tracer.cpp (whole images), progressive.cpp (images that grow), query.cpp (rays).
#pragma once
#include <chrono>
#include <optional>

#include "engine/base/stopwatch.h"
#include "engine/gpu/runner.h"
#include "engine/gpu/tracer.h"
#include "engine/image/sample_mean.h"

namespace splatray {

/// An image that advance() adds to, in a buffer of its own.
struct GrowingPicture {
  Look look;
  Dispatch dispatch;
  Footprint footprint;
  Buffer accumulation;         ///< means of all pixels over the samples behind those of `before`, vec4
  SampleMean before;           ///< of whole blocks
  std::uint32_t upload = 0;    ///< the upload() whose scene it shows; 0 = none was begun
  std::uint32_t samples = 0;   ///< in every pixel
  std::uint32_t next_row = 0;  ///< rows above it have one more
  std::uint32_t rows = 8;      ///< of the next dispatch
};

/// An image that is traced tile by tile.
struct Picture {
  Dispatch dispatch, aov_dispatch;
  Footprint footprint;
  std::vector<Tile> tiles;
  Image image;  ///< rgba and, where they are wanted, aov have room for all pixels
};

struct Tracer::Impl {
  Impl(const Context& context, const TracerOptions& options) : runner(context, options) {}

  /// Begins a call whose work is counted and timed.
  void start();
  /// Begins an image, `means` of each of whose pixels are traced at once; binds buffers with room for a tile of it.
  [[nodiscard]] Picture start_picture(const Look& look, const View& view, const Settings& settings,
                                      std::uint32_t means);
  /// Ends it.
  void finish(std::chrono::steady_clock::time_point start);
  /// Traces all samples of a tile, whose buffer is bound, with the work that each thread may do. `advance` hears of each batch, `take`
  /// gets the means of the first `half` samples, if any, and those of all. Returns false where a driver cut some pixel's loops; the
  /// device's milliseconds go into the statistics.
  using Take = std::function<void(std::uint32_t samples, const std::vector<vec4>& means)>;
  [[nodiscard]] bool trace_means(TileDispatch& aimed, const Tile& tile, std::uint32_t half,
                                 const ThreadWork& work, const std::function<void(std::uint32_t)>& advance,
                                 const Take& take);
  /// Puts a full block of the image that grows to those before it.
  void end_block();
  /// Reads the means of a tile back; nothing where a driver cut some pixel's loops.
  [[nodiscard]] std::optional<std::vector<vec4>> read_means(const Buffer& accumulation, const Tile& tile);

  Runner runner;
  GrowingPicture progressive;
  RenderStats stats;
  std::uint32_t uploads = 0;
};

/// Adds samples [begin, end) to a tile's means, whose buffer is bound, `batch` of them first and then as many as `batch` is made;
/// `advance` hears of each batch. Returns the device's milliseconds.
double trace_samples(Runner& runner, TileDispatch& tile, std::uint32_t begin, std::uint32_t end,
                     const ThreadWork& work, std::uint32_t& batch,
                     const std::function<void(std::uint32_t)>& advance);

/// Throws Error (interrupted) where `progress` says so.
void report(const Tracer::Progress& progress, double share);

/// Throws Error (failed): the driver cuts a single ray's loops.
[[noreturn]] void refuse_cut_loops();

}  // namespace splatray
