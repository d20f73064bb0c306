/// Runs dispatches over the scene on the device, and holds the buffers that they share.
#pragma once
#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "engine/device/device.h"
#include "engine/gpu/device_scene.h"
#include "engine/gpu/dispatch.h"
#include "engine/gpu/tracer.h"

namespace splatray {

class Runner {
 public:
  /// The device must outlive it.
  Runner(const Device& device, const TracerOptions& options);

  /// Binds everything a dispatch reads or writes; to be called where any of it may have changed. Waits for what was begun where some
  /// has.
  void bind(const Buffer& accumulation);
  /// Runs one dispatch, or that of a tile, and waits; returns the device's milliseconds and adds what was counted to `counts`.
  double run(const Dispatch& dispatch);
  double run(const TileDispatch& tile);

  /// An image's dispatch, all lights and samples; `settings` as Tracer::render takes them.
  [[nodiscard]] Dispatch picture_dispatch(const View& view, const Settings& settings) const;
  /// That of the AOVs of its pixels, whatever the look.
  [[nodiscard]] Dispatch aov_dispatch(const View& view, const Settings& settings) const;
  /// How much of it a dispatch may do.
  [[nodiscard]] ThreadWork work(const Dispatch& dispatch) const;
  /// Begins samples [begin, end) of a tile, the lights spread over as many dispatches as `work` asks for.
  void begin_samples(TileDispatch& tile, std::uint32_t begin, std::uint32_t end, const ThreadWork& work);
  /// Whether as many times samples were begun and not ended as the device is given at once.
  [[nodiscard]] bool is_busy() const { return begun_.size() >= in_flight_most_; }
  /// Waits for the samples that were begun first and not yet ended; returns the device's milliseconds, and counts as run().
  double end_samples();
  /// Waits for all that was begun, of which nothing is to be ended any more.
  void finish();
  /// AovPixels of a tile, put into `image` of `width` columns, top row first. `dispatch`: aov_dispatch's.
  void trace_aov(const Tile& tile, const Dispatch& dispatch, std::vector<AovPixel>& image,
                 std::uint32_t width);

  /// Throws Error (failed) unless there is a scene: `call` was made before upload().
  void require_scene(const char* call) const;

  /// Device memory of buffers that are as large as images are.
  [[nodiscard]] std::uint64_t buffer_bytes() const;

  const Device& device;
  const DeviceProfile profile;
  const std::unique_ptr<Queue> queue;
  DeviceScene scene;
  std::unique_ptr<Buffer> accumulation;     ///< of render(): a tile's means, vec4, then base colours
  std::unique_ptr<Buffer> aov, rays, hits;  ///< of a tile, and of queries
  Counters counts{};                        ///< summed over dispatches that count

 private:
  /// What begin_samples began.
  struct Begun {
    std::uint32_t dispatches = 0;  ///< that are not ended
    double ms = 0.0;               ///< of those that are
  };

  void take_groups(const TileDispatch& tile);
  void begin(const Dispatch& dispatch);
  void end_first();

  std::unique_ptr<Buffer> groups_;
  std::vector<std::uint32_t> group_list_;  ///< what groups_ holds
  const std::uint32_t in_flight_most_;
  std::uint32_t in_flight_ = 0;  ///< dispatches begun and not ended
  std::deque<Begun> begun_;
};

/// Puts a tile's values into an image of `width` columns.
template <class Value>
void place(const Tile& tile, const std::vector<Value>& values, std::vector<Value>& image,
           std::uint32_t width) {
  for (std::uint32_t row = 0; row < tile.height; ++row) {
    const auto source = values.begin() + std::ptrdiff_t{row} * tile.width;
    std::copy(source, source + tile.width, image.begin() + std::ptrdiff_t{tile.y + row} * width + tile.x);
  }
}

}  // namespace splatray
