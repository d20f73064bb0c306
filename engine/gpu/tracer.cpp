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

double trace_samples(Runner& runner, TileDispatch& tile, std::uint32_t begin, std::uint32_t end,
                     const ThreadWork& work, std::uint32_t& batch,
                     const std::function<void(std::uint32_t)>& advance) {
  // The device counts in 32 bits, which many samples of a large tile would overflow.
  const std::uint32_t most = has(tile.seen.constants, FEATURE_COUNTERS) ? 1 : work.samples;
  double all_ms = 0.0;
  for (std::uint32_t sample = begin; sample < end;) {
    const std::uint32_t next = sample + std::min(batch, end - sample);
    const double ms = runner.run_samples(tile, sample, next, work);
    all_ms += ms;
    advance(next - sample);
    batch = std::min(next_batch(next - sample, ms), most);
    sample = next;
  }
  return all_ms;
}

void report(const Tracer::Progress& progress, double share) {
  if (progress && !progress(share)) throw Error(ExitCode::interrupted, "rendering was interrupted");
}

void refuse_cut_loops() {
  throw Error(
      ExitCode::failed,
      "found a pixel whose ray takes more steps through the scene than this driver lets a thread make, "
      "expected fewer (another Vulkan driver may do it)");
}

void Tracer::Impl::start() {
  stats = {};
  runner.counts = {};
}

void Tracer::Impl::finish(Clock::time_point start) {
  stats.counters = runner.counts;
  stats.wall_ms = milliseconds_since(start);
}

std::optional<std::vector<vec4>> Tracer::Impl::read_means(const Buffer& accumulation, const Tile& tile) {
  std::vector<vec4> means(tile.pixels());
  accumulation.download(runner.queue, std::as_writable_bytes(std::span(means)));
  if (!std::all_of(means.begin(), means.end(), [](const vec4& mean) { return mean.w >= 0.0F; })) return {};
  return means;
}

bool Tracer::Impl::trace_means(TileDispatch& aimed, const Tile& tile, std::uint32_t half,
                               const ThreadWork& work, const std::function<void(std::uint32_t)>& advance,
                               const Take& take) {
  const std::uint32_t first = aimed.seen.frame.sample_begin, samples = aimed.seen.frame.sample_end - first;
  SampleMean before;
  std::uint32_t batch = 1;
  for (std::uint32_t done = 0; done < samples;) {
    const std::uint32_t block = before.samples(), block_end = std::min(block + BLOCK_SAMPLES, samples);
    const std::uint32_t next = done < half ? std::min(half, block_end) : block_end;
    aimed.set_mean_begin(first + block);
    stats.trace_ms += trace_samples(runner, aimed, first + done, first + next, work, batch, advance);
    done = next;
    std::optional<std::vector<vec4>> means = read_means(runner.accumulation, tile);
    if (!means) return false;
    if (done == half || done == samples) {
      std::vector<vec4> all = *means;
      before.join(all, 0, done - block);
      take(done, all);
    }
    if (done == block + BLOCK_SAMPLES) before.add(*std::move(means), BLOCK_SAMPLES);
  }
  return true;
}

Tracer::Tracer(const Context& context, const TracerOptions& options)
    : impl_(std::make_unique<Impl>(context, options)) {}

Tracer::~Tracer() = default;

void Tracer::upload(const Scene& scene) {
  impl_->runner.scene.upload(scene);
  ++impl_->uploads;
}

void Tracer::upload_and_free(Scene& scene) {
  impl_->runner.scene.upload_and_free(scene);
  ++impl_->uploads;
}

Picture Tracer::Impl::start_picture(const Look& look, const View& view, const Settings& settings,
                                    std::uint32_t means) {
  start();
  runner.scene.show(look);
  const PixelWindow made = view.made();
  const std::uint64_t pixels = std::uint64_t{made.width} * made.height;
  require_memory(pixels * image_bytes(settings), "a picture of " + std::to_string(made.width) + "x" +
                                                     std::to_string(made.height) + " pixels");
  Picture picture{runner.picture_dispatch(view, settings),
                  runner.aov_dispatch(view, settings),
                  runner.scene.footprint(view, settings),
                  cut_into_tiles(made.width, made.height, TILE_PIXELS / means),
                  {made.width, made.height, {}, {}, {}}};
  picture.image.rgba.resize(pixels);
  const std::size_t most_pixels = picture.tiles.front().pixels();
  reserve_storage(runner.context, runner.accumulation, means * most_pixels * sizeof(vec4));
  if (settings.aov) {
    picture.image.aov.resize(picture.image.rgba.size());
    reserve_storage(runner.context, runner.aov, most_pixels * sizeof(AovPixel));
  }
  runner.bind(runner.accumulation);
  return picture;
}

Image Tracer::render(const Look& look, const View& view, const Settings& settings, const Progress& progress) {
  Impl& impl = *impl_;
  Runner& runner = impl.runner;
  runner.require_scene("render()");
  const Clock::time_point start = Clock::now();
  Picture picture = impl.start_picture(look, view, settings, 1);
  Image& image = picture.image;
  const std::size_t pixels = image.rgba.size();
  Image first_half{image.width, image.height, {}, {}};
  if (settings.estimate_error) first_half.rgba.resize(pixels);
  const std::uint32_t half = settings.estimate_error ? settings.samples / 2 : 0;
  std::uint64_t done = 0;
  for (const Tile& tile : picture.tiles) {
    const auto trace = [&](const ThreadWork& work, bool again) {
      const auto advance = [&](std::uint32_t samples) {
        done += again ? 0 : tile.pixels() * samples;
        report(progress, static_cast<double>(done) / (static_cast<double>(pixels) * settings.samples));
      };
      const auto take = [&](std::uint32_t samples, const std::vector<vec4>& means) {
        place(tile, means, samples == half ? first_half.rgba : image.rgba, image.width);
      };
      TileDispatch aimed = aim(picture.dispatch, tile, picture.footprint);
      return impl.trace_means(aimed, tile, half, work, advance, take);
    };
    if (!trace(runner.work(picture.dispatch), false) && !trace({}, true)) refuse_cut_loops();
    if (settings.aov) runner.trace_aov(tile, picture.aov_dispatch, picture.footprint, image.aov, image.width);
  }
  impl.finish(start);
  impl.stats.samples = settings.samples;
  if (settings.estimate_error && settings.samples > 1) {
    image.error = pixel_errors(image.rgba, first_half.rgba);
    impl.stats.error = relative_error(image);
  }
  return std::move(image);
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
  const Footprint footprint = runner.scene.footprint(view, settings);
  const PixelWindow made = view.made();
  const auto tiles = cut_into_tiles(made.width, made.height, progress ? PROMPT_PIXELS : TILE_PIXELS);
  reserve_storage(runner.context, runner.aov, tiles.front().pixels() * sizeof(AovPixel));
  runner.bind(runner.accumulation);
  std::vector<AovPixel> pixels(std::size_t{made.width} * made.height);
  for (const Tile& tile : tiles) {
    runner.trace_aov(tile, dispatch, footprint, pixels, made.width);
    report(progress, double(tile.y + tile.height) / made.height);
  }
  impl.finish(start);
  impl.stats.trace_ms = impl.stats.wall_ms;
  return pixels;
}

const RenderStats& Tracer::stats() const { return impl_->stats; }

PoolBytes Tracer::pool_bytes() const {
  PoolBytes bytes = impl_->runner.scene.bytes();
  bytes.frame += impl_->runner.buffer_bytes() + impl_->progressive.accumulation.size();
  return bytes;
}

std::uint32_t Tracer::pipelines_built() const { return impl_->runner.pipelines.built(); }
std::uint32_t Tracer::pools_uploaded() const { return impl_->uploads; }

}  // namespace splatray
