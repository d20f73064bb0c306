#include "engine/gpu/tracer.h"

#include <algorithm>
#include <cassert>
#include <chrono>

#include "engine/base/error.h"
#include "engine/gpu/device_scene.h"
#include "engine/gpu/dispatch.h"
#include "engine/gpu/pipeline.h"
#include "engine/gpu/tiles.h"
#include "engine/vulkan/buffer.h"
#include "engine/vulkan/command_queue.h"

namespace splatray {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint32_t QUERY_RAYS = 1U << 20U;  ///< in one dispatch
/// Most samples of a dispatch on a processor, without and with secondary rays: Mesa's llvmpipe silently ends all loops of
/// a thread after 65 535 turns in all (LP_MAX_TGSI_LOOP_ITERATIONS).
constexpr std::uint32_t PROCESSOR_BATCH = 16, PROCESSOR_BATCH_OF_PATHS = 1;
/// Most groups of pixels whose paths are traced in stages together: their queues take 42 MB.
constexpr std::uint32_t STAGED_GROUPS = 4096;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

void report(const Tracer::Progress& progress, double share) {
  if (progress && !progress(share)) throw Error(ExitCode::interrupted, "rendering was interrupted");
}

/// Puts a tile's values into a picture of `width` columns.
template <class Value>
void place(const Tile& tile, const std::vector<Value>& values, std::vector<Value>& picture,
           std::uint32_t width) {
  for (std::uint32_t row = 0; row < tile.height; ++row) {
    const auto source = values.begin() + std::ptrdiff_t{row} * tile.width;
    std::copy(source, source + tile.width, picture.begin() + std::ptrdiff_t{tile.y + row} * width + tile.x);
  }
}

/// A picture that advance() adds to.
struct Growing {
  Dispatch dispatch;
  Footprint footprint;
  std::uint32_t samples = 0;   ///< in every pixel
  std::uint32_t next_row = 0;  ///< rows above it have one more
  std::uint32_t rows = 8;      ///< of the next dispatch
};

}  // namespace

struct Tracer::Impl {
  Impl(const Context& device, const PoolWish& wish, Arithmetic wanted_arithmetic, ProgramCode code);

  void bind_all();
  double run(const Dispatch& dispatch);
  double run_in_stages(const Dispatch& dispatch);
  double run(const TileDispatch& tile);
  void reserve_queues(std::uint32_t pixel_groups);
  [[nodiscard]] Dispatch picture_dispatch(const View& view, const Settings& settings) const;
  [[nodiscard]] std::uint32_t most_samples(const Dispatch& dispatch) const;
  void trace_samples(const Tile& tile, const Dispatch& dispatch, const Footprint& footprint,
                     const std::function<void(std::uint64_t)>& advance);
  void read_colors(const Tile& tile, Image& image);
  void trace_aov(const Tile& tile, Dispatch dispatch, const Footprint& footprint,
                 std::vector<AovPixel>& picture);

  const Context& context;
  const Arithmetic arithmetic;
  CommandQueue queue;
  PipelineCache pipelines;
  DeviceScene scene;
  Buffer frame_buffer, accumulation, aov, counters, rays, hits, groups, paths, queued_paths;

  std::vector<std::uint32_t> group_list;  ///< what `groups` holds
  Growing growing;
  std::array<std::uint32_t, COUNTER_COUNT> counted{};  ///< by the last dispatch, if it counts
  RenderStats stats;
  std::uint32_t pools_uploaded = 0;
};

Tracer::Impl::Impl(const Context& device, const PoolWish& wish, Arithmetic wanted_arithmetic,
                   ProgramCode code)
    : context(device),
      arithmetic(device.arithmetic(wanted_arithmetic)),
      queue(device),
      pipelines(device, code),
      scene(device, queue, wish) {
  reserve_storage(device, frame_buffer, sizeof(FrameParams));
  for (Buffer* buffer : {&accumulation, &aov, &rays, &hits, &groups}) reserve_storage(device, *buffer, 0);
  reserve_storage(device, counters, COUNTER_COUNT * sizeof(std::uint32_t));
  reserve_queues(1);
}

void Tracer::Impl::bind_all() {
  scene.bind();
  BindingSet& bindings = scene.bindings();
  bindings.bind(BIND_FRAME, frame_buffer);
  bindings.bind(BIND_ACCUMULATION, accumulation);
  bindings.bind(BIND_AOV, aov);
  bindings.bind(BIND_COUNTERS, counters);
  bindings.bind(BIND_RAYS, rays);
  bindings.bind(BIND_HITS, hits);
  bindings.bind(BIND_GROUPS, groups);
  bindings.bind(BIND_PATHS, paths);
  bindings.bind(BIND_PATHS_QUEUED, queued_paths);
}

double Tracer::Impl::run(const Dispatch& dispatch) {
  const BindingSet& bindings = scene.bindings();
  const bool counts = dispatch.constants[SPEC_COUNTERS] != 0;
  const bool queues = dispatch.program == Program::staged;
  const VkPipeline pipeline =
      pipelines.get({dispatch.program, scene.access(), arithmetic, dispatch.constants}, bindings.layout());
  const double ms = queue.run([&](VkCommandBuffer commands) {
    vkCmdUpdateBuffer(commands, frame_buffer.get(), 0, sizeof(FrameParams), &dispatch.frame);
    if (counts || queues) vkCmdFillBuffer(commands, counters.get(), 0, VK_WHOLE_SIZE, 0);
    record_barrier(commands);
    const VkDescriptorSet set = bindings.set();
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, bindings.layout(), 0, 1, &set, 0,
                            nullptr);
    vkCmdDispatch(commands, dispatch.groups_x, dispatch.groups_y, 1);
  });
  if (counts || queues) counters.download(queue, std::as_writable_bytes(std::span(counted)));
  if (counts)
    for (std::size_t i = 0; i < counted.size(); ++i) stats.counters[i] += counted[i];
  return ms;
}

void Tracer::Impl::reserve_queues(std::uint32_t pixel_groups) {
  const VkDeviceSize bytes = VkDeviceSize{pixel_groups} * GROUP_SIZE * sizeof(PathState);
  constexpr VkBufferUsageFlags USAGE =
      VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
  for (Buffer* buffer : {&paths, &queued_paths})
    if (buffer->size() < bytes) *buffer = Buffer(context, bytes, USAGE, VK_FORMAT_R32G32B32A32_UINT);
}

/// One sample of a dispatch's pixels: primary rays, then as long as paths go on one ray of each, packed together. Lanes of
/// processors, which wait for each other's branches and loops, otherwise stay idle once their path has ended (Laine, Karras and Aila
/// 2013, "Megakernels Considered Harmful").
double Tracer::Impl::run_in_stages(const Dispatch& dispatch) {
  assert(dispatch.frame.sample_end == dispatch.frame.sample_begin + 1);
  const std::uint32_t texels = context.properties.limits.maxTexelBufferElements;
  const std::uint32_t most =
      std::min({STAGED_GROUPS, dispatch.frame.group_count, texels / (PATH_TEXELS * GROUP_SIZE)});
  reserve_queues(most);
  Buffer *traced = &paths, *queued = &queued_paths;
  const auto run_stage = [&](const Dispatch& stage) {
    scene.bindings().bind(BIND_PATHS, *traced);
    scene.bindings().bind(BIND_PATHS_QUEUED, *queued);
    return run(stage);
  };
  double ms = 0.0;
  for (std::uint32_t first = 0; first < dispatch.frame.group_count; first += most) {
    Dispatch stage = dispatch;
    stage.constants[SPEC_STAGE] = STAGE_FIRST;
    stage.frame.first_group += first;
    stage.frame.group_count = std::min(most, dispatch.frame.group_count - first);
    stage.set_groups(stage.frame.group_count);
    ms += run_stage(stage);
    stage.constants[SPEC_STAGE] = STAGE_NEXT;
    while ((stage.frame.path_count = counted[COUNT_QUEUED]) > 0) {
      std::swap(traced, queued);
      ++stage.frame.path_bounce;
      stage.set_groups(splatray::groups(stage.frame.path_count, GROUP_SIZE));
      ms += run_stage(stage);
    }
  }
  return ms;
}

double Tracer::Impl::run(const TileDispatch& tile) {
  if (tile.group_list != group_list) {
    group_list = tile.group_list;
    reserve_storage(context, groups, std::span(group_list).size_bytes());
    scene.bindings().bind(BIND_GROUPS, groups);
    groups.upload(queue, std::as_bytes(std::span(group_list)));
  }
  double ms = 0.0;
  for (const Dispatch* part : {&tile.seen, &tile.empty})
    if (part->groups_x > 0) ms += part->program == Program::staged ? run_in_stages(*part) : run(*part);
  return ms;
}

Dispatch Tracer::Impl::picture_dispatch(const View& view, const Settings& settings) const {
  Dispatch dispatch;
  dispatch.constants = picture_features(scene.content(), settings);
  dispatch.frame = scene.picture_params(view, settings);
  const bool parts = dispatch.constants[SPEC_GLASS] != 0 && dispatch.frame.max_bounces > 0;
  if (parts && settings.stages && context.is_processor() && context.ballot)
    dispatch.program = Program::staged;
  return dispatch;
}

std::uint32_t Tracer::Impl::most_samples(const Dispatch& dispatch) const {
  if (!context.is_processor()) return UINT32_MAX;
  return dispatch.frame.max_bounces > 0 ? PROCESSOR_BATCH_OF_PATHS : PROCESSOR_BATCH;
}

void Tracer::Impl::trace_samples(const Tile& tile, const Dispatch& dispatch, const Footprint& footprint,
                                 const std::function<void(std::uint64_t)>& advance) {
  const bool counting = dispatch.constants[SPEC_COUNTERS] != 0;
  const std::uint32_t total = dispatch.frame.sample_total;
  const std::uint32_t most = most_samples(dispatch);
  TileDispatch aimed = aim(dispatch, tile, footprint);
  std::uint32_t batch = 1;
  for (std::uint32_t sample = 0; sample < total;) {
    const std::uint32_t end = sample + std::min(batch, total - sample);
    aimed.set_samples(sample, end);
    const double ms = run(aimed);
    stats.trace_ms += ms;
    advance(tile.pixels() * (end - sample));
    sample = end;
    // The device counts in 32 bits, which many samples of a large tile would overflow.
    if (!counting) batch = std::min(next_batch(batch, ms), most);
  }
}

void Tracer::Impl::read_colors(const Tile& tile, Image& image) {
  std::vector<vec4> means(tile.pixels());
  accumulation.download(queue, std::as_writable_bytes(std::span(means)));
  place(tile, means, image.rgba, image.width);
}

void Tracer::Impl::trace_aov(const Tile& tile, Dispatch dispatch, const Footprint& footprint,
                             std::vector<AovPixel>& picture) {
  dispatch.constants[SPEC_AOV] = 1;
  dispatch.program = Program::trace;
  run(aim(dispatch, tile, footprint));
  std::vector<AovPixel> pixels(tile.pixels());
  aov.download(queue, std::as_writable_bytes(std::span(pixels)));
  place(tile, pixels, picture, dispatch.frame.width);
}

Tracer::Tracer(const Context& context, const PoolWish& wish, Arithmetic arithmetic, ProgramCode code)
    : impl_(std::make_unique<Impl>(context, wish, arithmetic, code)) {}

Tracer::~Tracer() = default;

void Tracer::upload(const Scene& scene) {
  impl_->scene.upload(scene);
  ++impl_->pools_uploaded;
}

void Tracer::upload_and_free(Scene& scene) {
  impl_->scene.upload_and_free(scene);
  ++impl_->pools_uploaded;
}

void Tracer::set_materials(std::span<const Material> materials) {
  assert(materials.size() == impl_->scene.materials());
  impl_->scene.set_materials(materials);
}

void Tracer::set_lights(std::span<const SceneLight> lights) { impl_->scene.set_lights(lights); }

void Tracer::set_up(const glm::dvec3& up) { impl_->scene.set_up(up); }

void Tracer::set_environment(const Environment& environment) { impl_->scene.set_environment(environment); }

Image Tracer::render(const View& view, const Settings& settings, const Progress& progress) {
  Impl& impl = *impl_;
  assert(impl.scene.uploaded() && settings.samples >= 1);
  const Clock::time_point start = Clock::now();
  impl.stats = {};
  const Dispatch dispatch = impl.picture_dispatch(view, settings);
  const Footprint footprint = impl.scene.footprint(view, settings);
  Image image{view.width, view.height, {}, {}};
  const std::size_t pixels = std::size_t{view.width} * view.height;
  image.rgba.resize(pixels);
  if (settings.aov) image.aov.resize(pixels);

  const std::vector<Tile> tiles = cut_into_tiles(view.width, view.height);
  reserve_storage(impl.context, impl.accumulation, tiles.front().pixels() * sizeof(vec4));
  if (settings.aov) reserve_storage(impl.context, impl.aov, tiles.front().pixels() * sizeof(AovPixel));
  impl.bind_all();
  std::uint64_t done = 0;
  const auto advance = [&](std::uint64_t samples) {
    done += samples;
    report(progress, static_cast<double>(done) / (static_cast<double>(pixels) * settings.samples));
  };
  for (const Tile& tile : tiles) {
    impl.trace_samples(tile, dispatch, footprint, advance);
    impl.read_colors(tile, image);
    if (settings.aov) impl.trace_aov(tile, dispatch, footprint, image.aov);
  }
  impl.stats.wall_ms = milliseconds_since(start);
  return image;
}

void Tracer::begin(const View& view, const Settings& settings) {
  Impl& impl = *impl_;
  assert(impl.scene.uploaded() && settings.samples >= 1);
  impl.stats = {};
  impl.growing = {impl.picture_dispatch(view, settings), impl.scene.footprint(view, settings)};
  const VkDeviceSize bytes = VkDeviceSize{view.width} * view.height * sizeof(vec4);
  if (bytes > impl.context.properties.limits.maxStorageBufferRange)
    throw Error(ExitCode::out_of_memory,
                "found a picture of " + std::to_string(bytes) + " bytes, expected at most " +
                    std::to_string(impl.context.properties.limits.maxStorageBufferRange));
  reserve_storage(impl.context, impl.accumulation, bytes);
  impl.bind_all();
}

bool Tracer::advance(double wanted_ms) {
  Impl& impl = *impl_;
  Growing& growing = impl.growing;
  FrameParams& frame = growing.dispatch.frame;
  const std::uint32_t rows = std::min(growing.rows, frame.height - growing.next_row);
  frame.tile_first = growing.next_row * frame.width;
  frame.sample_begin = growing.samples;
  frame.sample_end = growing.samples + 1;
  const Clock::time_point start = Clock::now();
  impl.stats.trace_ms +=
      impl.run(aim(growing.dispatch, {0, growing.next_row, frame.width, rows}, growing.footprint));
  const double ms = milliseconds_since(start);
  impl.stats.wall_ms += ms;
  growing.rows = next_rows(rows, ms, wanted_ms, frame.height);
  growing.next_row += rows;
  if (growing.next_row == frame.height) {
    growing.next_row = 0;
    ++growing.samples;
  }
  return growing.samples == frame.sample_total;
}

std::uint32_t Tracer::samples() const { return impl_->growing.samples; }

Image Tracer::picture() {
  Impl& impl = *impl_;
  const FrameParams& frame = impl.growing.dispatch.frame;
  Image image{frame.width, frame.height, {}, {}};
  image.rgba.resize(std::size_t{frame.width} * frame.height);
  const std::uint32_t rows = impl.growing.samples > 0 ? frame.height : impl.growing.next_row;
  if (rows > 0) impl.read_colors({0, 0, frame.width, rows}, image);
  return image;
}

std::vector<AovPixel> Tracer::trace_aov(const View& view, const Settings& settings,
                                        const Progress& progress) {
  Impl& impl = *impl_;
  assert(impl.scene.uploaded());
  const Clock::time_point start = Clock::now();
  impl.stats = {};
  const Dispatch dispatch = impl.picture_dispatch(view, settings);
  const Footprint footprint = impl.scene.footprint(view, settings);
  const auto tiles = cut_into_tiles(view.width, view.height, progress ? PROMPT_PIXELS : TILE_PIXELS);
  reserve_storage(impl.context, impl.aov, tiles.front().pixels() * sizeof(AovPixel));
  impl.bind_all();
  std::vector<AovPixel> pixels(std::size_t{view.width} * view.height);
  for (const Tile& tile : tiles) {
    impl.trace_aov(tile, dispatch, footprint, pixels);
    report(progress, double(tile.y + tile.height) / view.height);
  }
  impl.stats.wall_ms = impl.stats.trace_ms = milliseconds_since(start);
  return pixels;
}

std::vector<RayHit> Tracer::intersect(std::span<const RayQuery> rays, const Settings& settings) {
  Impl& impl = *impl_;
  assert(impl.scene.uploaded());
  const Clock::time_point start = Clock::now();
  impl.stats = {};
  const std::size_t most = std::min<std::size_t>(rays.size(), QUERY_RAYS);
  reserve_storage(impl.context, impl.rays, most * sizeof(RayQuery));
  reserve_storage(impl.context, impl.hits, most * sizeof(RayHit));
  impl.bind_all();
  Dispatch dispatch;
  dispatch.program = Program::rays;
  dispatch.constants = query_features(impl.scene.content(), settings);
  dispatch.frame = impl.scene.query_params(settings);
  std::vector<RayHit> hits(rays.size());
  for (std::size_t at = 0; at < rays.size(); at += most) {
    const std::size_t count = std::min(most, rays.size() - at);
    impl.rays.upload(impl.queue, std::as_bytes(rays.subspan(at, count)));
    dispatch.frame.tile_width = dispatch.frame.width = static_cast<std::uint32_t>(count);
    dispatch.groups_x = groups(dispatch.frame.width, GROUP_SIZE);
    impl.stats.trace_ms += impl.run(dispatch);
    impl.hits.download(impl.queue, std::as_writable_bytes(std::span(hits).subspan(at, count)));
  }
  impl.stats.wall_ms = milliseconds_since(start);
  return hits;
}

const RenderStats& Tracer::stats() const { return impl_->stats; }
PoolBytes Tracer::pool_bytes() const {
  const Impl& impl = *impl_;
  PoolBytes bytes = impl.scene.bytes();
  for (const Buffer* buffer :
       {&impl.accumulation, &impl.aov, &impl.rays, &impl.hits, &impl.groups, &impl.paths, &impl.queued_paths})
    bytes.frame += buffer->size();
  return bytes;
}
std::uint32_t Tracer::pipelines_built() const { return impl_->pipelines.built(); }
std::uint32_t Tracer::pools_uploaded() const { return impl_->pools_uploaded; }

}  // namespace splatray
