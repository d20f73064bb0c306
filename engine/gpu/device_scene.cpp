#include "engine/gpu/device_scene.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <string>

#include "engine/base/error.h"
#include "engine/scene/surface.h"
#include "engine/table/albedo_table.h"

namespace splatray {
namespace {

/// Emitters as the table of lights has them.
std::vector<Light> balls_of(std::span<const Emitter> emitters) {
  std::vector<Light> balls;
  for (const Emitter& emitter : emitters) {
    Light& ball = balls.emplace_back();
    ball.position = vec3(emitter.center);
    ball.size = static_cast<float>(emitter.radius);
    ball.share = static_cast<float>(emitter.power);
  }
  return balls;
}

}  // namespace

DeviceScene::DeviceScene(const Context& context, CommandQueue& queue, const PoolWish& wish, bool culls)
    : context_(context), queue_(queue), wish_(wish), culls_(culls), environment_(context, queue, {}) {
  upload_tables({});
}

void DeviceScene::upload(const Scene& scene, Scene* spent) {
  bindings_.reset();
  pools_ = {};  // the device may not have room for two scenes
  cells_ = filled_cells(scene);
  emitters_ = balls_of(find_emitters(scene, scene.surfaces));
  clip_content_ = clip_content(scene.clip_pool);
  pools_ = Pools(context_, queue_, scene, wish_, spent);
  bindings_.emplace(context_, pools_.paging);
  outline_ = {};
  outline_.root = scene.root;
  outline_.up = scene.up;
  outline_.bounds_min_world = scene.bounds_min_world;
  outline_.bounds_max_world = scene.bounds_max_world;
  materials_ = scene.materials;
  set_materials(scene.materials, scene.surfaces);
  set_lights(scene.lights);
}

void DeviceScene::set_materials(std::span<const Material> materials, std::span<const Surface> surfaces) {
  if (materials.size() != materials_.size())
    throw Error(ExitCode::failed, "found " + std::to_string(materials.size()) +
                                      " materials, expected the scene's " +
                                      std::to_string(materials_.size()));
  materials_.assign(materials.begin(), materials.end());
  surfaces_.assign(surfaces.begin(), surfaces.end());
  if (surfaces.empty())
    std::transform(materials.begin(), materials.end(), std::back_inserter(surfaces_), surface_of);
  material_content_ = material_content(materials);
  surface_features_ = surface_features(surfaces_, materials);
  reserve_storage(context_, material_buffer_, materials.size_bytes());
  material_buffer_.upload(queue_, std::as_bytes(materials));
  reserve_storage(context_, surface_buffer_, std::span(surfaces_).size_bytes());
  surface_buffer_.upload(queue_, std::as_bytes(std::span(surfaces_)));
}

void DeviceScene::set_lights(std::span<const SceneLight> lights) {
  if (lights.size() > LIGHTS_MOST)
    throw Error(ExitCode::failed, "found " + std::to_string(lights.size()) + " lights, expected at most " +
                                      std::to_string(LIGHTS_MOST));
  const auto sized = static_cast<std::uint32_t>(std::count_if(lights.begin(), lights.end(), is_sized));
  if (sized > LIGHTS_SIZED_MOST)
    throw Error(ExitCode::failed, "found " + std::to_string(sized) +
                                      " lights that have a size, expected at most " +
                                      std::to_string(LIGHTS_SIZED_MOST));
  lights_ = lights_in_root(outline_, {lights.begin(), lights.end()});
  lights_sized_ = sized;
  light_irradiance_ = summed_irradiance(outline_, {lights.begin(), lights.end()});
  upload_lights();
}

void DeviceScene::set_emitters(std::span<const Emitter> emitters) {
  emitters_ = balls_of(emitters);
  upload_lights();
}

void DeviceScene::upload_lights() {
  std::vector<Light> table = lights_;
  table.insert(table.end(), emitters_.begin(), emitters_.end());
  reserve_storage(context_, light_buffer_, std::span(table).size_bytes());
  light_buffer_.upload(queue_, std::as_bytes(std::span(table)));
}

void DeviceScene::set_environment(const Environment& environment) {
  environment_ = EnvironmentTexture(context_, queue_, environment);
  environment_texture_ = !environment.texels.empty();
  environment_constant_ = environment.constant;
  irradiance_ = irradiance_coefficients(environment);
  sky_ = sky_table(environment);
  upload_tables(sky_);
  sky_.words = {};
}

/// What path tracing reads beside the scene.
void DeviceScene::upload_tables(const SkyTable& sky) {
  std::vector<std::uint32_t> words;
  for (const float albedo : ALBEDO_TABLE) words.push_back(std::bit_cast<std::uint32_t>(albedo));
  words.insert(words.end(), sky.words.begin(), sky.words.end());
  reserve_storage(context_, table_buffer_, std::span(words).size_bytes());
  table_buffer_.upload(queue_, std::as_bytes(std::span(words)));
}

void DeviceScene::bind() {
  for (std::uint32_t i = 0; i < pools_.buffers.size(); ++i)
    bindings_->bind(BIND_NODE_POOL + i, pools_.buffers[i]);
  bindings_->bind(BIND_MATERIALS, material_buffer_);
  bindings_->bind(BIND_LIGHTS, light_buffer_);
  bindings_->bind(environment_);
}

void DeviceScene::bind_light() {
  bindings_->bind(BIND_SURFACES, surface_buffer_);
  bindings_->bind(BIND_LIGHT_TABLES, table_buffer_);
}

PoolBytes DeviceScene::bytes() const {
  PoolBytes bytes = pools_.bytes;
  bytes.environment = environment_.size();
  return bytes;
}

SceneContent DeviceScene::content() const {
  return {.materials = material_content_,
          .colors = pools_.bytes.at(BIND_COLOR_POOL) > 0,
          .fields = pools_.bytes.at(BIND_FIELD_POOL) > 0,
          .clips = clip_content_.lines,
          .ellipses = clip_content_.ellipses,
          .references = pools_.references,
          .top_levels = pools_.top_levels,
          .pages = pools_.paging.pages_constant(),
          .page_shift = pools_.paging.page_shift,
          .surfaces = surface_features_,
          .lights = !lights_.empty(),
          .sized_lights = lights_sized_ > 0,
          .environment_texture = environment_texture_,
          .sky = sky_.width > 0};
}

FrameParams DeviceScene::picture_params(const View& view, const Settings& settings) const {
  FrameParams frame = make_frame_params(outline_, view, settings);
  const bool traces = settings.look == LOOK_LIT || settings.look == LOOK_CLAY;
  const bool mirrors = settings.look == LOOK_PAPER && (material_content_.mirrors || material_content_.glass);
  if (!traces && !mirrors) frame.max_bounces = 0;
  frame.light_end = static_cast<std::uint32_t>(lights_.size());
  frame.loop_probe = LOOP_PROBE;
  set_media(frame, materials_, surfaces_);
  frame.lights_sized = lights_sized_;
  frame.emitters = static_cast<std::uint32_t>(emitters_.size());
  set_sky(settings, frame);
  frame.environment =
      settings.environment_strength * (environment_texture_ ? glm::vec3(1.0F) : environment_constant_);
  for (std::size_t i = 0; i < irradiance_.size(); ++i)
    frame.irradiance[i] = glm::vec4(settings.environment_strength * irradiance_[i], 0.0F);
  return frame;
}

/// The environment is chosen as often as its light's share of all is, but neither it nor the lights less than one time in ten.
void DeviceScene::set_sky(const Settings& settings, FrameParams& frame) const {
  const bool traces = settings.look == LOOK_LIT || settings.look == LOOK_CLAY;
  if (sky_.width == 0 || !traces) return;
  const double sky = sky_.irradiance_mean * settings.environment_strength;
  const double share = std::clamp(sky / std::max(sky + light_irradiance_, 1e-30), 0.1, 0.9);
  frame.sky_width = sky_.width;
  frame.sky_height = sky_.height;
  frame.sky_share = lights_.empty() ? 1.0F : static_cast<float>(share);
}

FrameParams DeviceScene::query_params(const Settings& settings) const {
  FrameParams frame{};
  frame.tile_height = frame.height = 1;
  frame.kappa = settings.kappa;
  frame.root_unit_world = static_cast<float>(outline_.root.unit_world);
  frame.delta = static_cast<float>(settings.delta_world / outline_.root.unit_world);
  return frame;
}

Footprint DeviceScene::footprint(const View& view, const Settings& settings) const {
  const bool sized = settings.look != LOOK_PAPER && (settings.lens_radius_world > 0.0 || lights_sized_ > 0);
  if (!settings.cull || !culls_ || sized) return {view.width, view.height};
  return {cells_, outline_.root, view};
}

}  // namespace splatray
