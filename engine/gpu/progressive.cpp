// Tracer's images that grow sample by sample.
#include <algorithm>
#include <cmath>
#include <string>

#include "engine/base/error.h"
#include "engine/gpu/tracer_parts.h"

namespace splatray {

void Tracer::begin(const Look& look, const View& wanted, const Settings& settings) {
  View view = wanted;
  view.window = {};
  Impl& impl = *impl_;
  Runner& runner = impl.runner;
  runner.require_scene("begin()");
  const std::uint64_t bytes = std::uint64_t{view.width} * view.height * sizeof(vec4);
  const std::uint64_t most = runner.device.limits().storage_bytes;
  if (bytes > most)
    throw Error(ExitCode::out_of_memory, "found an image of " + std::to_string(bytes) +
                                             " bytes, expected at most " + std::to_string(most));
  impl.start();
  runner.scene.show(look);
  GrowingPicture& progressive = impl.progressive;
  std::unique_ptr<Buffer> accumulation = std::move(progressive.accumulation);
  std::unique_ptr<Buffer> before_means = std::move(progressive.before_means);
  runner.queue->reserve(accumulation, bytes);
  progressive = {.look = look,
                 .dispatch = runner.picture_dispatch(view, settings),
                 .accumulation = std::move(accumulation),
                 .before = {},
                 .before_means = std::move(before_means),
                 .upload = impl.uploads};
}

bool Tracer::advance(double wanted_ms) {
  Impl& impl = *impl_;
  GrowingPicture& progressive = impl.progressive;
  if (progressive.upload == 0 || progressive.upload != impl.uploads)
    throw Error(ExitCode::failed,
                "advance() was called without begin() after upload(), expected an image begun");
  FrameParams& frame = progressive.dispatch.frame;
  const std::uint32_t all = frame.sample_end - frame.sample_begin;
  if (progressive.samples == all) return true;
  const std::uint32_t left = frame.height - progressive.next_row;
  const std::uint32_t rows = std::isinf(wanted_ms) ? left : std::min(progressive.rows, left);
  frame.tile_first = progressive.next_row * frame.width;
  const auto start = std::chrono::steady_clock::now();
  impl.runner.scene.show(progressive.look);
  impl.runner.bind(*progressive.accumulation);
  impl.runner.scene.expect_rays(std::uint64_t{rows} * frame.width);
  TileDispatch tile = aim(progressive.dispatch, {0, progressive.next_row, frame.width, rows});
  tile.dispatch.frame.mean_begin = frame.sample_begin + progressive.before.samples();
  ThreadWork work = impl.runner.work(progressive.dispatch);
  const std::uint32_t sample = frame.sample_begin + progressive.samples;
  impl.runner.begin_samples(tile, sample, sample + 1, {1, work.lights});
  progressive.rows_begun.push_back(rows);
  progressive.next_row += rows;
  if (progressive.next_row == frame.height) {
    progressive.next_row = 0;
    ++progressive.samples;
    if (progressive.samples < all) impl.end_block();
  }
  while (!progressive.rows_begun.empty() && (progressive.samples == all || impl.runner.is_busy()))
    impl.end_rows(wanted_ms);
  impl.stats.counters = impl.runner.counts;
  impl.stats.wall_ms += milliseconds_since(start);
  return progressive.samples == all;
}

void Tracer::Impl::end_rows(double wanted_ms) {
  const std::uint32_t rows = progressive.rows_begun.front();
  progressive.rows_begun.pop_front();
  const double ms = runner.end_samples();
  stats.trace_ms += ms;
  if (std::isfinite(wanted_ms))
    progressive.rows = next_rows(rows, ms, wanted_ms, progressive.dispatch.frame.height);
}

void Tracer::Impl::end_block() {
  if (progressive.samples - progressive.before.samples() < BLOCK_SAMPLES) return;
  const FrameParams& frame = progressive.dispatch.frame;
  std::vector<vec4> means(std::size_t{frame.width} * frame.height);
  if (!read_means(runner, *progressive.accumulation, means)) refuse_cut_loops();
  progressive.before.add(std::move(means), BLOCK_SAMPLES);
}

std::uint32_t Tracer::samples() const { return impl_->progressive.samples; }

Image Tracer::picture() {
  Impl& impl = *impl_;
  const GrowingPicture& progressive = impl.progressive;
  if (progressive.upload == 0)
    throw Error(ExitCode::failed, "picture() was called without begin(), expected an image begun");
  const FrameParams& frame = progressive.dispatch.frame;
  Image image{frame.width, frame.height, {}, {}};
  image.rgba.resize(std::size_t{frame.width} * frame.height);
  const std::uint32_t rows = progressive.samples > 0 ? frame.height : progressive.next_row;
  if (rows == 0) return image;
  const std::span<vec4> means = std::span(image.rgba).first(std::size_t{rows} * frame.width);
  if (!read_means(impl.runner, *progressive.accumulation, means)) refuse_cut_loops();
  const std::uint32_t samples = progressive.samples - progressive.before.samples();
  const std::size_t more = std::size_t{progressive.next_row} * frame.width;
  progressive.before.join(means.first(more), 0, samples + 1);
  progressive.before.join(means.subspan(more), more, samples);
  return image;
}

GrownPicture Tracer::grown() {
  GrowingPicture& progressive = impl_->progressive;
  if (progressive.upload == 0)
    throw Error(ExitCode::failed, "grown() was called without begin(), expected an image begun");
  const FrameParams& frame = progressive.dispatch.frame;
  const std::uint32_t before = progressive.before.samples();
  if (progressive.uploaded_before != before) {
    std::vector<vec4> means(std::size_t{frame.width} * frame.height);
    progressive.before.join(means, 0, 0);
    impl_->runner.queue->reserve(progressive.before_means, std::span(means).size_bytes());
    impl_->runner.queue->upload(*progressive.before_means, std::as_bytes(std::span(means)));
    progressive.uploaded_before = before;
  }
  return {.width = frame.width,
          .height = frame.height,
          .means = progressive.accumulation.get(),
          .before = before > 0 ? progressive.before_means.get() : progressive.accumulation.get(),
          .samples_before = before,
          .samples = progressive.samples - before,
          .next_row = progressive.next_row};
}

}  // namespace splatray
