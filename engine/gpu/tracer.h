/// The engine: a scene on the device, and pictures and ray queries of it.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/device/device.h"
#include "engine/gpu/pools.h"
#include "engine/image/image.h"
#include "engine/image/look.h"
#include "engine/image/view.h"

namespace splatray {

/// What a render call, or all of a picture begun, did. Times in milliseconds.
struct RenderStats {
  /// Device time where it has timestamps, else wall time of the dispatches; without those for AOVs.
  double trace_ms = 0.0;
  double wall_ms = 0.0;  ///< the whole call, read-back included
  /// Relative error of the whole picture (picture_error.h); 0 where it was not estimated.
  double error = 0.0;
  double samples = 0.0;  ///< per pixel, on the mean
  /// Zero unless Settings::counters; without the AOVs' rays.
  std::array<std::uint64_t, COUNTER_COUNT> counters{};

  /// Rays of all kinds, as counted.
  [[nodiscard]] std::uint64_t rays() const {
    return counters[COUNT_PRIMARY] + counters[COUNT_SHADOW] + counters[COUNT_REFLECTED] +
           counters[COUNT_REFRACTED];
  }
};

struct TracerOptions {
  /// Where compiled pipelines are kept between runs; empty = nowhere.
  std::filesystem::path pipeline_folder{};
  PoolRequest pools{};                     ///< for tests and benchmarks
  unsigned threads = 0;                    ///< of the host's CPU as the device; 0 = one a core
  std::uint32_t vector_bits = UINT32_MAX;  ///< QueueOptions::vector_bits, for tests and benchmarks
  std::uint32_t in_flight = 0;             ///< DeviceProfile::in_flight, for tests; 0 = the device's
};

/// What becomes of an image whose tracing `progress` stops.
enum class Stopped {
  dropped,  ///< Error (interrupted)
  kept,     ///< it has the samples that all its pixels have; their first one is made to its end
};

/// A picture begun, where it grows: on the device.
struct GrownPicture {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  const Buffer* means = nullptr;     ///< vec4 of each pixel: the mean of the samples that are not in `before`
  const Buffer* before = nullptr;    ///< vec4 of each pixel: the mean of the first samples; not null
  std::uint32_t samples_before = 0;  ///< in each pixel of `before`
  std::uint32_t samples = 0;         ///< in each pixel of `means`
  std::uint32_t next_row = 0;        ///< rows above it have one more
};

/// What a filter is guided by, of each pixel of a picture, where it is: on the device.
struct DeviceGuide {
  const Buffer* aov = nullptr;   ///< AovPixel
  const Buffer* base = nullptr;  ///< vec4: base colours
};

/// What it shows is given with each call; of a look, what equals that of the call before is not uploaded again. Calls that make
/// no sense, such as images of no scene or a look of other objects, throw Error (failed) with a sentence that says so.
class Tracer {
 public:
  /// The device must outlive the tracer.
  explicit Tracer(const Device& device, const TracerOptions& options = {});
  ~Tracer();
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  /// Called before the pools of a scene are uploaded: prepare() may be, so that programs are built meanwhile.
  using Planned = std::function<void()>;
  /// Uploads the pools. Throws Error (out_of_memory) with the sizes when a pool does not fit the device.
  void upload(const Scene& scene, const Planned& planned = {});
  /// As upload, but frees the scene's pools, each as soon as it is on the device, also where that then throws: a host needs
  /// the memory of a large scene once, not twice. All else of the scene stays.
  void upload_and_free(Scene& scene, const Planned& planned = {});

  /// Called between dispatches with the share done, 0..1; returns false to stop: Error (interrupted), but for images that are
  /// kept.
  using Progress = std::function<bool(double)>;
  /// The image of the uploaded scene. Where it is stopped and kept, stats().samples says how many samples it has, and its
  /// estimated error is infinite when these were not even half.
  [[nodiscard]] Image render(const Look& look, const View& view, const Settings& settings,
                             const Progress& progress = {}, Stopped stopped = Stopped::dropped);
  /// The picture whose error is as small as the goal asks for: regions get samples until they are good enough, at most
  /// Settings::samples in a pixel. Two pictures of independent samples are made, and the samples of each depend on the other
  /// alone, so that their mean is unbiased: where samples were counted until they look good, it would not be. Its error is half
  /// their difference.
  [[nodiscard]] Image render_until(const Look& look, const View& view, const Settings& settings,
                                   const Goal& goal, const Progress& progress = {});
  /// Begins to build the programs of a picture on other threads, of its AOVs too where Settings::aov is set; render(), begin() and
  /// trace_aov() of it then wait for less.
  void prepare(const Look& look, const View& view, const Settings& settings);
  /// Starts a picture that grows by advance(), and drops the one before. Once all samples are in, it is bit for bit what render()
  /// gives, whatever other calls than upload() happened between. Settings::aov and View::window are not looked at.
  /// Throws Error (out_of_memory) for more pixels than the device lets a buffer hold.
  void begin(const Look& look, const View& view, const Settings& settings);
  /// Adds one sample to some rows of the picture begun, aiming at `wanted_ms` of work, infinity: to all that lack it; returns whether
  /// all of Settings::samples are in every pixel. After upload() begin() must come first. The device may still be at it, and stats()
  /// lack its time, until all of them are.
  bool advance(double wanted_ms);
  [[nodiscard]] std::uint32_t samples() const;  ///< in every pixel of the picture begun
  /// The picture begun: each pixel the mean of its samples so far, black without one.
  [[nodiscard]] Image picture();
  /// The same where it is, until the next call of begin, advance or upload.
  [[nodiscard]] GrownPicture grown();
  /// What the ray through each pixel's centre hits, top row first. With `progress` in dispatches small enough for an
  /// answer within some tens of ms.
  [[nodiscard]] std::vector<AovPixel> trace_aov(const Look& look, const View& view, const Settings& settings,
                                                const Progress& progress = {});
  /// As trace_aov, and the picture of `base`, settings of few samples, left on the device until the next call of this; white where there
  /// are none.
  [[nodiscard]] DeviceGuide trace_guide(const Look& look, const View& view, const Settings& settings,
                                        const std::optional<Settings>& base, const Progress& progress = {});
  /// Hits of arbitrary rays, one RayHit per query. Root space. Of the look the materials count.
  [[nodiscard]] std::vector<RayHit> intersect(const Look& look, std::span<const RayQuery> rays,
                                              const Settings& settings);

  /// Counts and times of the last call of begin and advance, render, trace_aov or intersect.
  [[nodiscard]] const RenderStats& stats() const;
  [[nodiscard]] PoolBytes pool_bytes() const;           ///< device memory as of now
  [[nodiscard]] std::uint32_t pipelines_built() const;  ///< since construction
  [[nodiscard]] std::uint32_t pools_uploaded() const;   ///< upload() calls since construction

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace splatray
