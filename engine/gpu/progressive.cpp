// Tracer's images that grow sample by sample.
#include <algorithm>
#include <string>

#include "engine/base/error.h"
#include "engine/gpu/tracer_parts.h"

namespace splatray {

void Tracer::begin(const View& wanted, const Settings& settings) {
  View view = wanted;
  view.window = {};
  Impl& impl = *impl_;
  Runner& runner = impl.runner;
  runner.require_scene("begin()");
  const VkDeviceSize bytes = VkDeviceSize{view.width} * view.height * sizeof(vec4);
  const std::uint32_t most = runner.context.properties.limits.maxStorageBufferRange;
  if (bytes > most)
    throw Error(ExitCode::out_of_memory, "found an image of " + std::to_string(bytes) +
                                             " bytes, expected at most " + std::to_string(most));
  impl.start();
  Progressive& progressive = impl.progressive;
  Buffer accumulation = std::move(progressive.accumulation);
  reserve_storage(runner.context, accumulation, bytes);
  progressive = {.dispatch = runner.picture_dispatch(view, settings),
                 .footprint = runner.scene.footprint(view, settings),
                 .accumulation = std::move(accumulation),
                 .upload = impl.uploads};
}

bool Tracer::advance(double wanted_ms) {
  Impl& impl = *impl_;
  Progressive& progressive = impl.progressive;
  if (progressive.upload == 0 || progressive.upload != impl.uploads)
    throw Error(ExitCode::failed,
                "advance() was called without begin() after upload(), expected an image begun");
  FrameParams& frame = progressive.dispatch.frame;
  if (progressive.samples == frame.sample_total) return true;
  const std::uint32_t rows = std::min(progressive.rows, frame.height - progressive.next_row);
  frame.tile_first = progressive.next_row * frame.width;
  const auto start = std::chrono::steady_clock::now();
  impl.runner.bind(progressive.accumulation);
  TileDispatch tile =
      aim(progressive.dispatch, {0, progressive.next_row, frame.width, rows}, progressive.footprint);
  ThreadWork work = impl.runner.work(progressive.dispatch);
  const double trace_ms =
      impl.runner.run_samples(tile, progressive.samples, progressive.samples + 1, {1, work.lights});
  const double ms = milliseconds_since(start);
  impl.stats.counters = impl.runner.counts;
  impl.stats.trace_ms += trace_ms;
  impl.stats.wall_ms += ms;
  progressive.rows = next_rows(rows, ms, wanted_ms, frame.height);
  progressive.next_row += rows;
  if (progressive.next_row == frame.height) {
    progressive.next_row = 0;
    ++progressive.samples;
  }
  return progressive.samples == frame.sample_total;
}

std::uint32_t Tracer::samples() const { return impl_->progressive.samples; }

Image Tracer::picture() {
  Impl& impl = *impl_;
  const Progressive& progressive = impl.progressive;
  if (progressive.upload == 0)
    throw Error(ExitCode::failed, "picture() was called without begin(), expected an image begun");
  const FrameParams& frame = progressive.dispatch.frame;
  Image image{frame.width, frame.height, {}, {}};
  image.rgba.resize(std::size_t{frame.width} * frame.height);
  const std::uint32_t rows = progressive.samples > 0 ? frame.height : progressive.next_row;
  if (rows > 0 && !impl.read_colors(progressive.accumulation, {0, 0, frame.width, rows}, image))
    refuse_cut_loops();
  return image;
}

}  // namespace splatray
