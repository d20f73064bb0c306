#include "engine/gpu/runner.h"

#include <algorithm>

#include "engine/base/error.h"

namespace splatray {
namespace {

/// Lights that shadow rays are sent to at each hit: all or, with path tracing, one; with LOOK_SCAN the sky beside.
std::uint32_t lights_at_hit(const Dispatch& dispatch) {
  if (dispatch.program == Program::light) return 2;
  return has(dispatch.constants, FEATURE_LIGHTS) ? dispatch.frame.light_end : 0;
}

}  // namespace

Runner::Runner(const Device& its_device, const TracerOptions& options)
    : device(its_device),
      profile(device.profile()),
      queue(device.make_queue({options.pipeline_folder, options.threads, options.vector_bits})),
      scene(device, *queue, options.pools),
      in_flight_most_(options.in_flight > 0 ? options.in_flight : profile.in_flight) {
  for (std::unique_ptr<Buffer>* buffer : {&accumulation, &aov, &rays, &hits, &groups_})
    queue->reserve(*buffer, 0);
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
}

double Runner::run(const Dispatch& dispatch) {
  const Ran ran = queue->run(dispatch, scene.bindings());
  scene.require_whole();
  if (dispatch.counts_work())
    for (std::size_t i = 0; i < counts.size(); ++i) counts[i] += ran.counted[i];
  return ran.ms;
}

double Runner::run(const TileDispatch& tile) {
  take_groups(tile);
  return tile.dispatch.groups_x > 0 ? run(tile.dispatch) : 0.0;
}

/// Brings a tile's groups to the device, unless they are the first of those that are there.
void Runner::take_groups(const TileDispatch& tile) {
  const std::vector<std::uint32_t>& list = tile.group_list;
  if (list.size() <= group_list_.size() && std::equal(list.begin(), list.end(), group_list_.begin())) return;
  group_list_ = list;
  queue->reserve(groups_, std::span(group_list_).size_bytes());
  scene.bindings().bind(BIND_GROUPS, *groups_);
  queue->upload(*groups_, std::as_bytes(std::span(group_list_)));
}

void Runner::begin(const Dispatch& dispatch) {
  if (dispatch.groups_x == 0) return;
  if (dispatch.counts_work()) return void(begun_.back().ms += run(dispatch));
  while (in_flight_ >= in_flight_most_) end_first();
  queue->begin(dispatch, scene.bindings());
  ++in_flight_;
  ++begun_.back().dispatches;
}

void Runner::end_first() {
  const auto first =
      std::find_if(begun_.begin(), begun_.end(), [](const Begun& samples) { return samples.dispatches > 0; });
  first->ms += queue->end().ms;
  --first->dispatches;
  --in_flight_;
  scene.require_whole();
}

double Runner::end_samples() {
  while (begun_.front().dispatches > 0) end_first();
  const double ms = begun_.front().ms;
  begun_.pop_front();
  return ms;
}

void Runner::finish() {
  while (in_flight_ > 0) {
    --in_flight_;
    queue->end();
  }
  begun_.clear();
}

Dispatch Runner::picture_dispatch(const View& view, const Settings& settings) const {
  if (settings.samples < 1) throw Error(ExitCode::failed, "found settings of 0 samples, expected at least 1");
  Dispatch dispatch;
  dispatch.constants = picture_features(scene.content(), settings);
  dispatch.frame = scene.picture_params(view, settings);
  const bool has_lens = dispatch.frame.lens_u != vec3(0.0F);  // orthographic pictures and panoramas have none
  if (!has_lens) dispatch.constants[SPEC_FEATURES] &= ~FEATURE_LENS;
  if (settings.look != LOOK_PAPER) dispatch.program = Program::light;
  return dispatch;
}

Dispatch Runner::aov_dispatch(const View& view, const Settings& settings) const {
  Settings phong = settings;
  phong.look = LOOK_PAPER;
  Dispatch dispatch = picture_dispatch(view, phong);
  dispatch.constants[SPEC_FACES] = picture_features(scene.content(), settings)[SPEC_FACES];
  dispatch.constants[SPEC_OUTPUT] = OUTPUT_AOV;
  return dispatch;
}

ThreadWork Runner::work(const Dispatch& dispatch) const {
  const std::uint32_t lights = lights_at_hit(dispatch);
  return profile.work(1 + dispatch.frame.max_bounces, lights);
}

void Runner::begin_samples(TileDispatch& tile, std::uint32_t begin, std::uint32_t end,
                           const ThreadWork& work) {
  const std::uint32_t lights = lights_at_hit(tile.dispatch);
  take_groups(tile);
  begun_.emplace_back();
  tile.set_samples(begin, end);
  if (tile.dispatch.program == Program::light) return this->begin(tile.dispatch);
  tile.set_lights(0, std::min(work.lights, lights));
  this->begin(tile.dispatch);
  if (lights <= work.lights) return;
  TileDispatch more = tile;
  more.dispatch.frame.environment = vec3(0.0F);
  std::fill(std::begin(more.dispatch.frame.irradiance), std::end(more.dispatch.frame.irradiance), vec4(0.0F));
  for (std::uint32_t light = work.lights; light < lights; light += work.lights) {
    more.set_lights(light, std::min(light + work.lights, lights));
    this->begin(more.dispatch);
  }
  tile.set_lights(0, lights);
}

void Runner::trace_aov(const Tile& tile, const Dispatch& dispatch, std::vector<AovPixel>& image,
                       std::uint32_t width) {
  run(aim(dispatch, tile));
  std::vector<AovPixel> pixels(tile.pixels());
  queue->download(*aov, std::as_writable_bytes(std::span(pixels)));
  place(tile, pixels, image, width);
}

std::uint64_t Runner::buffer_bytes() const {
  std::uint64_t bytes = 0;
  for (const auto* buffer : {&accumulation, &aov, &rays, &hits, &groups_}) bytes += (*buffer)->size();
  return bytes;
}

}  // namespace splatray
