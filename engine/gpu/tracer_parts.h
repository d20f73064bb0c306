/// What the parts of Tracer share: tracer.cpp (whole images), progressive.cpp (images that grow), query.cpp (rays).
#pragma once
#include <chrono>
#include <deque>

#include "engine/base/stopwatch.h"
#include "engine/gpu/passes.h"
#include "engine/gpu/runner.h"
#include "engine/gpu/tracer.h"
#include "engine/image/sample_mean.h"

namespace splatray {

/// An image that advance() adds to, in a buffer of its own.
struct GrowingPicture {
  Look look;
  Dispatch dispatch;
  /// Means of all pixels over the samples behind those of `before`, vec4; none before the first begin().
  std::unique_ptr<Buffer> accumulation;
  SampleMean before;                       ///< of whole blocks
  std::unique_ptr<Buffer> before_means;    ///< its means, as grown() last had them
  std::uint32_t uploaded_before = 0;       ///< samples of those
  std::uint32_t upload = 0;                ///< the upload() whose scene it shows; 0 = none was begun
  std::uint32_t samples = 0;               ///< in every pixel
  std::uint32_t next_row = 0;              ///< rows above it have one more
  std::uint32_t rows = 8;                  ///< of the next dispatch
  std::deque<std::uint32_t> rows_begun{};  ///< of each time that samples were begun and not ended
};

/// An image that is traced tile by tile.
struct Picture {
  Dispatch dispatch, aov_dispatch;
  std::vector<Tile> tiles;
  Image image;  ///< rgba and, where they are wanted, aov have room for all pixels
};

struct Tracer::Impl {
  Impl(const Device& device, const TracerOptions& options) : runner(device, options) {}
  ~Impl();
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  /// Begins a call whose work is counted and timed, once all is done that was begun.
  void start();
  /// Waits for all that was begun, of which nothing is told any more.
  void finish_begun();
  /// Begins an image, `means` of each of whose pixels are traced at once, of which a tile has `tile_means` at most; binds buffers
  /// with room for a tile of it. Throws Error (out_of_memory) where there is less than the image and `more_bytes` a pixel take.
  [[nodiscard]] Picture start_picture(const Look& look, const View& view, const Settings& settings,
                                      std::uint32_t means, std::uint32_t tile_means = TILE_PIXELS,
                                      std::uint64_t more_bytes = 0);
  /// Ends it.
  void finish(std::chrono::steady_clock::time_point start);
  /// Waits for the rows begun first of the image that grows, and learns from them how many take `wanted_ms`.
  void end_rows(double wanted_ms);
  /// Puts a full block of the image that grows to those before it.
  void end_block();
  Runner runner;
  GrowingPicture progressive;
  std::unique_ptr<Buffer> guide_aov, guide_base;  ///< of trace_guide()
  RenderStats stats;
  std::uint32_t uploads = 0;
};

/// Throws Error (interrupted) where `progress` says so and it may.
void report(const Tracer::Progress& progress, double share, bool may_stop = true);

}  // namespace splatray
