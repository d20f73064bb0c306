#include "engine/gpu/runner.h"

#include <algorithm>

#include "engine/base/error.h"

namespace splatray {
namespace {

/// Most groups of pixels whose paths are traced in stages together: their queues take 42 MB.
constexpr std::uint32_t STAGED_GROUPS = 4096;

PoolRequest pool_request(const TracerOptions& options, const DeviceProfile& profile) {
  PoolRequest request = options.pools;
  request.access = profile.access();
  return request;
}

/// Lights that shadow rays are sent to at each hit: all or, with path tracing, one; with LOOK_SCAN the sky beside.
std::uint32_t lights_at_hit(const Dispatch& dispatch) {
  if (dispatch.program == Program::light) return 2;
  return has(dispatch.constants, FEATURE_LIGHTS) ? dispatch.frame.light_end : 0;
}

}  // namespace

Runner::Runner(const Device& its_device, const TracerOptions& options)
    : device(its_device),
      profile(device.profile(options.kernels)),
      queue(device.make_queue(
          {options.kernels, options.pipeline_folder, options.threads, options.vector_bits})),
      scene(device, *queue, pool_request(options, profile), profile.culls) {
  for (std::unique_ptr<Buffer>* buffer : {&accumulation, &aov, &rays, &hits, &groups_})
    queue->reserve(*buffer, 0);
  reserve_queues(1);
}

void Runner::require_scene(const char* call) const {
  if (!scene.uploaded())
    throw Error(ExitCode::failed, std::string(call) + " was called before upload(), expected a scene");
}

void Runner::bind(const Buffer& accumulation_buffer) {
  scene.bind();
  Bindings& bindings = scene.bindings();
  bindings.bind(BIND_ACCUMULATION, accumulation_buffer);
  bindings.bind(BIND_AOV, *aov);
  bindings.bind(BIND_RAYS, *rays);
  bindings.bind(BIND_HITS, *hits);
  bindings.bind(BIND_GROUPS, *groups_);
  bindings.bind(BIND_PATHS, *paths_);
  bindings.bind(BIND_PATHS_QUEUED, *queued_paths_);
}

double Runner::run(const Dispatch& dispatch) {
  const Ran ran = queue->run(dispatch, scene.bindings());
  if (dispatch.counts_work())
    for (std::size_t i = 0; i < counts.size(); ++i) counts[i] += ran.counted[i];
  queued_ = static_cast<std::uint32_t>(ran.counted[COUNT_QUEUED]);
  return ran.ms;
}

void Runner::reserve_queues(std::uint32_t pixel_groups) {
  const std::uint64_t bytes = std::uint64_t{pixel_groups} * GROUP_SIZE * sizeof(PathState);
  for (std::unique_ptr<Buffer>* buffer : {&paths_, &queued_paths_})
    queue->reserve(*buffer, bytes, BufferKind::texels);
}

/// One sample of a dispatch's pixels: primary rays, then as long as paths go on one ray of each, packed together
/// (stage/paths.glsl).
double Runner::run_in_stages(const Dispatch& dispatch) {
  const auto fitting =
      static_cast<std::uint32_t>(device.limits().texel_elements / (PATH_TEXELS * GROUP_SIZE));
  const std::uint32_t most = std::min({STAGED_GROUPS, dispatch.frame.group_count, fitting});
  reserve_queues(most);
  Buffer *traced = paths_.get(), *queued = queued_paths_.get();
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
    while ((stage.frame.path_count = queued_) > 0) {
      std::swap(traced, queued);
      ++stage.frame.path_bounce;
      stage.set_groups(splatray::groups(stage.frame.path_count, GROUP_SIZE));
      ms += run_stage(stage);
    }
  }
  return ms;
}

double Runner::run(const TileDispatch& tile) {
  if (tile.group_list != group_list_) {
    group_list_ = tile.group_list;
    queue->reserve(groups_, std::span(group_list_).size_bytes());
    scene.bindings().bind(BIND_GROUPS, *groups_);
    queue->upload(*groups_, std::as_bytes(std::span(group_list_)));
  }
  double ms = 0.0;
  for (const Dispatch* part : {&tile.seen, &tile.empty})
    if (part->groups_x > 0) ms += part->is_staged() ? run_in_stages(*part) : run(*part);
  return ms;
}

Dispatch Runner::picture_dispatch(const View& view, const Settings& settings) const {
  if (settings.samples < 1) throw Error(ExitCode::failed, "found settings of 0 samples, expected at least 1");
  Dispatch dispatch;
  dispatch.constants = picture_features(scene.content(), settings);
  dispatch.frame = scene.picture_params(view, settings);
  if (settings.look != LOOK_PAPER) dispatch.program = Program::light;
  const bool uneven = dispatch.program == Program::light || has(dispatch.constants, FEATURE_GLASS);
  if (uneven && dispatch.frame.max_bounces > 0 && settings.stages && profile.stages)
    dispatch.constants[SPEC_STAGE] = STAGE_FIRST;
  return dispatch;
}

Dispatch Runner::aov_dispatch(const View& view, const Settings& settings) const {
  Settings phong = settings;
  phong.look = LOOK_PAPER;
  Dispatch dispatch = picture_dispatch(view, phong);
  dispatch.constants[SPEC_FACES] = picture_features(scene.content(), settings)[SPEC_FACES];
  dispatch.constants[SPEC_STAGE] = STAGE_AOV;
  return dispatch;
}

ThreadWork Runner::work(const Dispatch& dispatch) const {
  const std::uint32_t lights = lights_at_hit(dispatch);
  if (dispatch.is_staged()) return {1, profile.work(1, lights).lights};
  return profile.work(1 + dispatch.frame.max_bounces, lights);
}

double Runner::run_samples(TileDispatch& tile, std::uint32_t begin, std::uint32_t end,
                           const ThreadWork& work) {
  const std::uint32_t lights = lights_at_hit(tile.seen);
  tile.set_samples(begin, end);
  if (tile.seen.program == Program::light) return run(tile);
  tile.set_lights(0, std::min(work.lights, lights));
  double ms = run(tile);
  if (lights <= work.lights) return ms;
  TileDispatch more = tile;
  more.empty.groups_x = 0;
  more.seen.frame.environment = vec3(0.0F);
  std::fill(std::begin(more.seen.frame.irradiance), std::end(more.seen.frame.irradiance), vec4(0.0F));
  for (std::uint32_t light = work.lights; light < lights; light += work.lights) {
    more.set_lights(light, std::min(light + work.lights, lights));
    ms += run(more);
  }
  tile.set_lights(0, lights);
  return ms;
}

void Runner::trace_aov(const Tile& tile, const Dispatch& dispatch, const Footprint& footprint,
                       std::vector<AovPixel>& image, std::uint32_t width) {
  run(aim(dispatch, tile, footprint));
  std::vector<AovPixel> pixels(tile.pixels());
  queue->download(*aov, std::as_writable_bytes(std::span(pixels)));
  place(tile, pixels, image, width);
}

std::uint64_t Runner::buffer_bytes() const {
  std::uint64_t bytes = 0;
  for (const auto* buffer : {&accumulation, &aov, &rays, &hits, &groups_, &paths_, &queued_paths_})
    bytes += (*buffer)->size();
  return bytes;
}

}  // namespace splatray
