/// What the parts of Tracer share: tracer.cpp (whole images), progressive.cpp (images that grow), query.cpp (rays).
#pragma once
#include <chrono>

#include "engine/base/stopwatch.h"
#include "engine/gpu/runner.h"
#include "engine/gpu/tracer.h"

namespace splatray {

/// An image that advance() adds to, in a buffer of its own.
struct Progressive {
  Dispatch dispatch;
  Footprint footprint;
  Buffer accumulation;         ///< means of all pixels, vec4
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
  [[nodiscard]] Picture start_picture(const View& view, const Settings& settings, std::uint32_t means);
  /// Ends it.
  void finish(std::chrono::steady_clock::time_point start, double trace_ms);
  /// Reads the means of a tile back from `accumulation` into the image. Returns false where a driver cut some pixel's loops.
  [[nodiscard]] bool read_colors(const Buffer& accumulation, const Tile& tile, Image& image);

  Runner runner;
  Progressive progressive;
  RenderStats stats;
  std::uint32_t uploads = 0;
};

/// Adds samples [begin, end) to a tile's means, whose buffer is bound; tells `advance` of each batch. Returns the device's
/// milliseconds.
double trace_samples(Runner& runner, TileDispatch& tile, std::uint32_t begin, std::uint32_t end,
                     const ThreadWork& work, const std::function<void(std::uint32_t)>& advance);

/// Throws Error (interrupted) where `progress` says so.
void report(const Tracer::Progress& progress, double share);

/// Throws Error (failed): the driver cuts a single ray's loops.
[[noreturn]] void refuse_cut_loops();

}  // namespace splatray
