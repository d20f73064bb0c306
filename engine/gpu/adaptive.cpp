// Tracer's pictures that end when they are good enough.
#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/error.h"
#include "engine/gpu/tracer_parts.h"
#include "engine/image/picture_error.h"

namespace splatray {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint32_t REGION = 32;  ///< edge of a region, pixels
/// Samples of each half in every pixel of the first round; each later round doubles a region's.
constexpr std::uint32_t FIRST_SAMPLES = 4;
/// Fraction of the picture's mean radiance: darker regions count as if they had it.
constexpr double DARK_SHARE = 0.02;
constexpr double NOISE = 1e-6;  ///< a relative error that is float32's
constexpr std::uint32_t SEED_STEP = 0x9E3779B9U;

/// One of two independent pictures of a tile.
struct Half {
  std::vector<vec4> means, means_before;  ///< of the pixels; before the last round of each region
  std::vector<std::uint32_t> samples;     ///< of each region
  std::vector<double> errors;             ///< of each region, relative: by how much its last round changed it
};

/// A tile that is traced until it is good enough.
class AdaptiveTile {
 public:
  AdaptiveTile(Runner& runner, const Dispatch& dispatch, const Tile& tile)
      : runner_(runner),
        dispatch_(dispatch),
        tile_(tile),
        columns_((tile.width + REGION - 1) / REGION),
        regions_(columns_ * ((tile.height + REGION - 1) / REGION)) {
    for (Half& half : halves_) {
      half.means.resize(tile.pixels());
      half.samples.assign(regions_, 0);
      half.errors.assign(regions_, 0.0);
    }
  }

  /// `proceed` is asked between dispatches.
  void trace(const Goal& goal, const std::function<bool(double error)>& proceed) {
    for (std::uint32_t half = 0; half < 2; ++half)
      step(half, std::vector<bool>(regions_, true), FIRST_SAMPLES);
    double wanted = goal.error > 0.0 ? goal.error * std::sqrt(2.0) : 0.7 * worst_;
    bool more = true;
    while (more && proceed(worst_)) {
      more = goal.error <= 0.0 && wanted > NOISE;
      for (std::uint32_t half = 0; half < 2; ++half)
        for (std::uint32_t samples = FIRST_SAMPLES; samples < most_samples(); samples *= 2) {
          const std::vector<bool> chosen = regions_above(half, samples, wanted);
          if (std::none_of(chosen.begin(), chosen.end(), [](bool c) { return c; })) continue;
          more = true;
          step(half, chosen, samples);
          if (!proceed(worst_)) return;
        }
      if (goal.error <= 0.0) wanted *= 0.7;
    }
  }

  /// Puts the mean of the halves, half their difference and one of them into an image.
  void put(Image& image) const {
    std::vector<vec4> means(tile_.pixels());
    for (std::size_t i = 0; i < means.size(); ++i)
      means[i] = 0.5F * (halves_[0].means[i] + halves_[1].means[i]);
    std::vector<float> errors = pixel_errors(halves_[0].means, halves_[1].means);
    for (float& error : errors) error *= 0.5F;
    place(tile_, means, image.rgba, image.width);
    place(tile_, errors, image.error, image.width);
    place(tile_, halves_[0].means, image.part, image.width);
  }

  /// Samples of all pixels together.
  [[nodiscard]] double samples() const {
    double sum = 0.0;
    for (std::uint32_t y = 0; y < tile_.height; ++y)
      for (std::uint32_t x = 0; x < tile_.width; ++x)
        for (const Half& half : halves_) sum += half.samples[region_at(x, y)];
    return sum;
  }

  [[nodiscard]] double trace_ms() const { return trace_ms_; }

 private:
  [[nodiscard]] std::size_t region_at(std::uint32_t x, std::uint32_t y) const {
    return std::size_t{y / REGION} * columns_ + x / REGION;
  }

  /// Most samples of a half in a region, about.
  [[nodiscard]] std::uint32_t most_samples() const { return dispatch_.frame.sample_end / 2; }

  /// Regions of a half that have `samples` and are worse than wanted, as what the other half says lets expect of that many: a
  /// half's own samples must not decide how many they are.
  [[nodiscard]] std::vector<bool> regions_above(std::uint32_t half, std::uint32_t samples,
                                                double wanted) const {
    const Half& other = halves_[1 - half];
    std::vector<bool> above(regions_);
    for (std::size_t r = 0; r < regions_; ++r)
      above[r] = halves_[half].samples[r] == samples &&
                 other.errors[r] * std::sqrt(double(other.samples[r]) / double(samples)) > wanted;
    return above;
  }

  /// Doubles the samples of some regions of a half, or gives all their first.
  void step(std::uint32_t which, const std::vector<bool>& chosen, std::uint32_t count) {
    Half& half = halves_[which];
    Dispatch dispatch = dispatch_;
    dispatch.frame.seed += which * SEED_STEP;
    dispatch.frame.tile_first = static_cast<std::uint32_t>(which * tile_.pixels());
    TileDispatch aimed = aim(dispatch, tile_);
    aimed.keep([&](std::uint32_t x, std::uint32_t y) { return chosen[region_at(x, y)]; });
    const auto run = [&](std::uint32_t begin, std::uint32_t end) {
      half.means_before = half.means;
      std::uint32_t batch = 1;
      trace_ms_ +=
          trace_samples(runner_, aimed, begin, end, runner_.work(dispatch), batch, [](std::uint32_t) {});
      read(which);
    };
    const bool first = half.samples.front() == 0;
    // The first samples are two rounds, so that there is a change to look at.
    if (first) run(0, count / 2);
    first ? run(count / 2, count) : run(count, 2 * count);
    for (std::size_t r = 0; r < regions_; ++r)
      if (chosen[r]) half.samples[r] = first ? count : 2 * count;
    judge(half, chosen);
  }

  void read(std::uint32_t which) {
    std::vector<vec4> both(2 * tile_.pixels());
    runner_.queue->download(*runner_.accumulation, std::as_writable_bytes(std::span(both)));
    const auto begin = both.begin() + static_cast<std::ptrdiff_t>(which * tile_.pixels());
    halves_[which].means.assign(begin, begin + static_cast<std::ptrdiff_t>(tile_.pixels()));
    if (std::any_of(halves_[which].means.begin(), halves_[which].means.end(),
                    [](const vec4& mean) { return mean.w < 0.0F; }))
      refuse_cut_loops();
  }

  /// Errors of the chosen regions, whose last round doubled their samples: by how much it changed them.
  void judge(Half& half, const std::vector<bool>& chosen) {
    const double dark = DARK_SHARE * mean_radiance(half.means);
    std::vector<double> squares(regions_, 0.0), sums(regions_, 0.0), counts(regions_, 0.0);
    for (std::uint32_t y = 0; y < tile_.height; ++y)
      for (std::uint32_t x = 0; x < tile_.width; ++x) {
        const std::size_t pixel = std::size_t{y} * tile_.width + x, region = region_at(x, y);
        const vec3 apart(half.means[pixel] - half.means_before[pixel]);
        squares[region] += double(glm::dot(apart, apart)) / 3.0;
        sums[region] += mean_radiance(std::span(&half.means[pixel], 1));
        ++counts[region];
      }
    for (std::size_t r = 0; r < regions_; ++r)
      if (chosen[r])
        half.errors[r] = std::sqrt(squares[r] / counts[r]) / std::max(sums[r] / counts[r] + dark, 1e-30);
    worst_ = 0.0;
    for (const Half& one : halves_)
      for (const double error : one.errors) worst_ = std::max(worst_, error);
  }

  Runner& runner_;
  const Dispatch dispatch_;
  const Tile tile_;
  const std::uint32_t columns_;
  const std::size_t regions_;
  std::array<Half, 2> halves_;
  double worst_ = 0.0;  ///< error of any region of a half
  double trace_ms_ = 0.0;
};

}  // namespace

Image Tracer::render_until(const Look& look, const View& view, const Settings& wanted, const Goal& goal,
                           const Progress& progress) {
  Settings settings = wanted;
  settings.sample_offset = 0;
  Impl& impl = *impl_;
  Runner& runner = impl.runner;
  runner.require_scene("render_until()");
  const Clock::time_point start = Clock::now();
  Picture picture = impl.start_picture(look, view, settings, 2);
  Image& image = picture.image;
  const std::size_t pixels = image.rgba.size();
  image.error.resize(pixels);
  image.part.resize(pixels);
  double samples = 0.0, done = 0.0;
  for (const Tile& tile : picture.tiles) {
    const double share = static_cast<double>(tile.pixels()) / static_cast<double>(pixels);
    const double end_ms = 1e3 * goal.seconds * (done + share);
    double first_error = 0.0;
    AdaptiveTile adaptive(runner, picture.dispatch, tile);
    adaptive.trace(goal, [&](double error) {
      first_error = std::max(first_error, error);
      const double ms = milliseconds_since(start);
      const double by_error = goal.error > 0.0 && error > goal.error
                                  ? std::log(first_error / error) / std::log(first_error / goal.error)
                                  : 0.0;
      report(
          progress,
          done + share * std::clamp(std::max(by_error, std::isfinite(end_ms) ? ms / end_ms : 0.0), 0.0, 1.0));
      return ms < end_ms;
    });
    adaptive.put(image);
    impl.stats.trace_ms += adaptive.trace_ms();
    samples += adaptive.samples();
    done += share;
    if (settings.aov) runner.trace_aov(tile, picture.aov_dispatch, image.aov, image.width);
  }
  impl.finish(start);
  impl.stats.samples = samples / static_cast<double>(pixels);
  impl.stats.error = relative_error(image);
  return std::move(image);
}

}  // namespace splatray
