#include "engine/gpu/tracer.h"

#include <algorithm>
#include <string>

#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "engine/gpu/tracer_parts.h"
#include "engine/image/picture_error.h"

namespace splatray {
namespace {

using Clock = std::chrono::steady_clock;

}  // namespace

void report(const Tracer::Progress& progress, double share, bool may_stop) {
  if (progress && !progress(share) && may_stop)
    throw Error(ExitCode::interrupted, "rendering was interrupted");
}

Tracer::Impl::~Impl() {
  try {
    finish_begun();
  } catch (const std::exception&) {
    // The device was lost: it does nothing more.
  }
}

void Tracer::Impl::start() {
  finish_begun();
  stats = {};
  runner.counts = {};
}

void Tracer::Impl::finish_begun() {
  runner.finish();
  progressive.rows_begun.clear();
}

void Tracer::Impl::finish(Clock::time_point start) {
  stats.counters = runner.counts;
  stats.wall_ms = milliseconds_since(start);
}

Tracer::Tracer(const Device& device, const TracerOptions& options)
    : impl_(std::make_unique<Impl>(device, options)) {}

Tracer::~Tracer() = default;

void Tracer::upload(const Scene& scene, const Planned& planned) {
  impl_->finish_begun();
  impl_->runner.scene.upload(scene, planned);
  ++impl_->uploads;
}

void Tracer::upload_and_free(Scene& scene, const Planned& planned) {
  impl_->finish_begun();
  impl_->runner.scene.upload_and_free(scene, planned);
  ++impl_->uploads;
}

Picture Tracer::Impl::start_picture(const Look& look, const View& view, const Settings& settings,
                                    std::uint32_t means, std::uint32_t tile_means, std::uint64_t more_bytes) {
  start();
  runner.scene.show(look);
  const PixelWindow made = view.made();
  const std::uint64_t pixels = std::uint64_t{made.width} * made.height;
  require_memory(
      pixels * (image_bytes(settings) + more_bytes),
      "a picture of " + std::to_string(made.width) + "x" + std::to_string(made.height) + " pixels");
  Picture picture{runner.picture_dispatch(view, settings),
                  runner.aov_dispatch(view, settings),
                  cut_into_tiles(made.width, made.height, tile_means / means),
                  {made.width, made.height, {}, {}, {}}};
  picture.image.rgba.resize(pixels);
  runner.scene.expect_rays(pixels * settings.samples);
  const std::size_t most_pixels = picture.tiles.front().pixels();
  runner.queue->reserve(runner.accumulation, means * most_pixels * sizeof(vec4));
  if (settings.aov) {
    picture.image.aov.resize(picture.image.rgba.size());
    runner.queue->reserve(runner.aov, most_pixels * sizeof(AovPixel));
  }
  runner.bind(*runner.accumulation);
  if (settings.aov)
    runner.queue->prepare(picture.aov_dispatch, runner.scene.bindings());  // beside the picture's
  return picture;
}

namespace {

/// Puts one of the `values` means of each pixel of tiles that stand one behind the other into an image.
void place_tiles(std::span<const Tile> tiles, const std::vector<vec4>& means, std::size_t values,
                 std::size_t which, std::vector<vec4>& image, std::uint32_t width) {
  std::size_t first = 0;
  for (const Tile& tile : tiles) {
    const auto begin = means.begin() + static_cast<std::ptrdiff_t>(first + which * tile.pixels());
    place(tile, std::vector<vec4>(begin, begin + static_cast<std::ptrdiff_t>(tile.pixels())), image, width);
    first += values * tile.pixels();
  }
}

/// That of render(), with the base colours where they are wanted.
Dispatch samples_dispatch(const Runner& runner, const View& view, const Settings& settings) {
  Dispatch dispatch = runner.picture_dispatch(view, settings);
  if (settings.albedo) dispatch.constants[SPEC_OUTPUT] = OUTPUT_BASE;
  return dispatch;
}

/// Adds samples until there are `end` in each pixel, or fewer that are kept where `progress` says stop.
void add_samples(Passes& passes, std::uint32_t end, Stopped stopped, const Passes::Advance& advance) {
  try {
    while (passes.samples() < end) passes.add(end, advance);
  } catch (const Error& error) {
    if (error.code() != ExitCode::interrupted || stopped != Stopped::kept) throw;
  }
}

}  // namespace

Image Tracer::render(const Look& look, const View& view, const Settings& settings, const Progress& progress,
                     Stopped stopped) {
  Impl& impl = *impl_;
  Runner& runner = impl.runner;
  runner.require_scene("render()");
  const Clock::time_point start = Clock::now();
  const bool keeps = stopped == Stopped::kept;
  // Who stops a picture waits for a tile's samples.
  const std::uint32_t tile_pixels = keeps && runner.profile.slow ? PROMPT_PIXELS : TILE_PIXELS;
  if (settings.albedo && settings.look == LOOK_PAPER)
    throw Error(ExitCode::failed, "found base colours asked of LOOK_PAPER, expected another look");
  const std::uint32_t values = settings.albedo ? 2 : 1;
  Picture picture = impl.start_picture(look, view, settings, values, tile_pixels,
                                       keeps ? values * range_bytes(settings.samples) : 0);
  Image& image = picture.image;
  picture.dispatch = samples_dispatch(runner, view, settings);
  if (settings.albedo) image.albedo.resize(image.rgba.size());
  std::vector<vec4> first_half(settings.estimate_error ? image.rgba.size() : 0);
  const std::uint32_t half = settings.estimate_error ? settings.samples / 2 : 0;
  // Made to its end, as without it nothing could be kept.
  const std::uint64_t first_pass = keeps ? image.rgba.size() : 0;
  const double all = static_cast<double>(image.rgba.size()) * settings.samples;
  std::uint64_t done = 0;
  const auto advance = [&](std::uint64_t samples) {
    done += samples;
    report(progress, static_cast<double>(done) / all, done > first_pass);
  };
  // What is kept when it is stopped has as many samples in all tiles; else a tile at a time takes less memory.
  const std::size_t together = keeps ? picture.tiles.size() : 1;
  for (std::size_t first = 0; first < picture.tiles.size(); first += together) {
    const auto tiles = std::span<const Tile>(picture.tiles).subspan(first, together);
    Passes passes(runner, picture.dispatch, tiles, keeps ? 1 : BLOCK_SAMPLES);
    add_samples(passes, half, stopped, advance);
    if (half > 0) place_tiles(tiles, passes.means(), values, 0, first_half, image.width);
    if (passes.samples() == half) add_samples(passes, settings.samples, stopped, advance);
    const std::vector<vec4> means = passes.means();
    place_tiles(tiles, means, values, 0, image.rgba, image.width);
    if (settings.albedo) place_tiles(tiles, means, values, 1, image.albedo, image.width);
    impl.stats.trace_ms += passes.trace_ms();
    impl.stats.samples = passes.samples();
    if (!settings.aov) continue;
    for (const Tile& tile : tiles) runner.trace_aov(tile, picture.aov_dispatch, image.aov, image.width);
  }
  impl.finish(start);
  if (settings.estimate_error && settings.samples > 1) {
    estimate_errors(std::move(first_half), half, impl.stats.samples, image);
    impl.stats.error = relative_error(image);
  }
  return std::move(image);
}

void Tracer::prepare(const Look& look, const View& view, const Settings& settings) {
  Runner& runner = impl_->runner;
  runner.require_scene("prepare()");
  runner.scene.show(look);
  runner.queue->prepare(samples_dispatch(runner, view, settings), runner.scene.bindings());
  if (settings.aov) runner.queue->prepare(runner.aov_dispatch(view, settings), runner.scene.bindings());
}

std::vector<AovPixel> Tracer::trace_aov(const Look& look, const View& view, const Settings& settings,
                                        const Progress& progress) {
  Impl& impl = *impl_;
  Runner& runner = impl.runner;
  runner.require_scene("trace_aov()");
  const Clock::time_point start = Clock::now();
  impl.start();
  runner.scene.show(look);
  const Dispatch dispatch = runner.aov_dispatch(view, settings);
  const PixelWindow made = view.made();
  const auto tiles = cut_into_tiles(made.width, made.height, progress ? PROMPT_PIXELS : TILE_PIXELS);
  runner.queue->reserve(runner.aov, tiles.front().pixels() * sizeof(AovPixel));
  runner.bind(*runner.accumulation);
  std::vector<AovPixel> pixels(std::size_t{made.width} * made.height);
  for (const Tile& tile : tiles) {
    runner.trace_aov(tile, dispatch, pixels, made.width);
    report(progress, double(tile.y + tile.height) / made.height);
  }
  impl.finish(start);
  impl.stats.trace_ms = impl.stats.wall_ms;
  return pixels;
}

const RenderStats& Tracer::stats() const { return impl_->stats; }

PoolBytes Tracer::pool_bytes() const {
  PoolBytes bytes = impl_->runner.scene.bytes();
  bytes.frame += impl_->runner.buffer_bytes();
  for (const auto* buffer : {&impl_->progressive.accumulation, &impl_->guide_aov, &impl_->guide_base})
    bytes.frame += *buffer ? (*buffer)->size() : 0;
  return bytes;
}

std::uint32_t Tracer::pipelines_built() const { return impl_->runner.queue->programs_built(); }
std::uint32_t Tracer::pools_uploaded() const { return impl_->uploads; }

}  // namespace splatray
