#include "engine/gpu/passes.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/stopwatch.h"

namespace splatray {
namespace {

/// What a pass should take: what is lost where it is stopped, and long beside reading its means back.
constexpr double PASS_MS = 1000.0;
constexpr double PASS_GROWTH = 8.0;

std::uint32_t next_pass(std::uint32_t samples, double ms) {
  const double wanted = samples * PASS_MS / std::max(ms, 1e-3);
  return static_cast<std::uint32_t>(std::clamp(wanted, 1.0, samples * PASS_GROWTH));
}

}  // namespace

bool read_means(Runner& runner, const Buffer& accumulation, std::span<vec4> means) {
  runner.queue->download(accumulation, std::as_writable_bytes(means));
  return std::all_of(means.begin(), means.end(), [](const vec4& mean) { return mean.w >= 0.0F; });
}

double trace_samples(Runner& runner, TileDispatch& tile, std::uint32_t begin, std::uint32_t end,
                     const ThreadWork& work, std::uint32_t& batch,
                     const std::function<void(std::uint32_t)>& advance) {
  // The device counts in 32 bits, which many samples of a large tile would overflow.
  const std::uint32_t most = has(tile.dispatch.constants, FEATURE_COUNTERS) ? 1 : work.samples;
  double all_ms = 0.0;
  std::deque<std::uint32_t> begun;  // samples of each batch
  const auto end_batch = [&] {
    const std::uint32_t samples = begun.front();
    begun.pop_front();
    const double ms = runner.end_samples();
    all_ms += ms;
    advance(samples);
    batch = std::min(next_batch(samples, ms), most);
  };
  try {
    for (std::uint32_t sample = begin; sample < end; sample += begun.back()) {
      while (runner.is_busy()) end_batch();
      begun.push_back(std::min(batch, end - sample));
      runner.begin_samples(tile, sample, sample + begun.back(), work);
    }
    while (!begun.empty()) end_batch();
  } catch (...) {
    runner.finish();
    throw;
  }
  return all_ms;
}

void refuse_cut_loops() {
  throw Error(
      ExitCode::failed,
      "found a pixel whose ray takes more steps through the scene than this driver lets a thread make, "
      "expected fewer (--device cpu does it, and other Vulkan drivers may)");
}

Passes::Passes(Runner& runner, const Dispatch& dispatch, std::span<const Tile> tiles, std::uint32_t first)
    : runner_(runner),
      dispatch_(dispatch),
      values_(dispatch.constants[SPEC_OUTPUT] == OUTPUT_BASE ? 2 : 1),
      tiles_(tiles),
      work_(runner.work(dispatch)),
      pass_(first) {
  std::size_t pixels = 0;
  for (const Tile& tile : tiles) pixels += tile.pixels();
  block_.resize(values_ * pixels);
}

void Passes::add(std::uint32_t end, const Advance& advance) {
  const auto start = std::chrono::steady_clock::now();
  if (in_block_ == BLOCK_SAMPLES) {
    std::vector<vec4> next(block_.size());
    before_.add(std::exchange(block_, std::move(next)), BLOCK_SAMPLES);
    in_block_ = 0;
  }
  const std::uint32_t begin = samples();
  const std::uint32_t next = std::min({begin + pass_, end, before_.samples() + BLOCK_SAMPLES});
  std::vector<vec4> more = block_;
  std::size_t first = 0;
  for (const Tile& tile : tiles_) {
    const std::span<vec4> means = std::span(more).subspan(first, values_ * tile.pixels());
    const auto of_block = std::span<const vec4>(block_).subspan(first, values_ * tile.pixels());
    bool again = false;
    const auto once = [&](std::uint64_t samples) { advance(again ? 0 : samples); };
    if (!trace(tile, means, next, once)) {
      again = true;
      work_ = {};
      std::copy(of_block.begin(), of_block.end(), means.begin());
      if (!trace(tile, means, next, once)) refuse_cut_loops();
    }
    first += values_ * tile.pixels();
  }
  block_ = std::move(more);
  in_block_ = next - before_.samples();
  pass_ = next_pass(next - begin, milliseconds_since(start));
}

/// Takes a tile from the samples that it has to `end` of them. Returns false where a driver cut some pixel's loops.
bool Passes::trace(const Tile& tile, std::span<vec4> means, std::uint32_t end, const Advance& advance) {
  const std::uint32_t offset = dispatch_.frame.sample_begin;
  if (in_block_ > 0) runner_.queue->upload(*runner_.accumulation, std::as_bytes(means));
  TileDispatch aimed = aim(dispatch_, tile);
  aimed.dispatch.frame.mean_begin = offset + before_.samples();
  std::uint32_t batch = 1;
  trace_ms_ += trace_samples(runner_, aimed, offset + samples(), offset + end, work_, batch,
                             [&](std::uint32_t count) { advance(tile.pixels() * count); });
  return read_means(runner_, *runner_.accumulation, means);
}

std::vector<vec4> Passes::means() const {
  std::vector<vec4> all = block_;
  before_.join(all, 0, in_block_);
  return all;
}

}  // namespace splatray
