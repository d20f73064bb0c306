#include "engine/gpu/device_scene.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>

#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "engine/base/release.h"
#include "engine/file/file_mapping.h"
#include "engine/scene/look_style.h"
#include "engine/scene/pool/huge_pages.h"
#include "engine/scene/pool/pool_table.h"
#include "engine/scene/scene_splat.h"
#include "engine/scene/wide/wide_tree.h"
#include "engine/table/albedo_table.h"

namespace splatray {
namespace {

/// Whether light that each object sends out leaves both of its faces.
std::vector<bool> two_sided_objects(std::span<const Material> materials) {
  std::vector<bool> two_sided;
  for (const Material& material : materials)
    two_sided.push_back((material.flags & (MATERIAL_TWO_SIDED | MATERIAL_DIELECTRIC)) != 0);
  return two_sided;
}

/// In place of no texels.
const Environment BLACK{1, 1, {glm::vec3(0.0F)}, glm::vec3(0.0F)};

}  // namespace

DeviceScene::DeviceScene(const Device& device, Queue& queue, const PoolRequest& request)
    : device_(device), queue_(queue), request_(request), environment_(queue.make_texture(BLACK)) {
  upload_tables({});
}

void DeviceScene::upload(const Scene& scene, Scene* spent, const Planned& planned) {
  if (queue_.walks_wide_tree() && !has_wide_tree(scene)) {
    Scene ordered = scene;
    if (spent != nullptr) for_each_pool([&](const auto& row) { spent->*row.pool = {}; });
    add_wide_tree(ordered);
    upload(ordered, &ordered, planned);
    return;
  }
  bindings_.reset();
  wide_nodes_.reset();
  pools_ = {};  // the device may not have room for two scenes
  walked_.clear();
  PoolRequest request = request_;
  if (queue_.walks_wide_tree()) request.data = DataPool::references;
  plan(scene, request);
  try {
    if (planned) planned();
    const std::size_t splats = splat_count(scene);
    if (queue_.walks_wide_tree()) list_walked(scene);
    if (queue_.walks_wide_tree())
      wide_nodes_ = queue_.lend(std::as_bytes(std::span(scene.wide_nodes)), scene.wide_nodes.keeper());
    if (spent != nullptr) spent->wide_nodes = {};
    pools_ = upload_pools(queue_, plan_, scene, spent);
    if (scene.mapping) scene.mapping->require_whole();
    if (wide_nodes_) bindings_->bind_wide_tree(*wide_nodes_, splats);
  } catch (...) {
    bindings_.reset();
    throw;
  }
}

/// Notes where the arrays are that rays wait for; they stay there, lent.
void DeviceScene::list_walked(const Scene& scene) {
  walked_.push_back({BIND_DATA_POOL, std::as_bytes(std::span(scene.wide_nodes))});
  std::uint32_t binding = BIND_POOLS;
  for_each_pool([&](const auto& row) {
    if (row.listed() && plan_.bytes.at(binding) > 0)
      walked_.push_back({binding, std::as_bytes(std::span(scene.*row.pool))});
    ++binding;
  });
  walked_bytes_ = rays_ = 0;
  for (const WalkedArray& array : walked_) walked_bytes_ += array.bytes.size();
}

void DeviceScene::expect_rays(std::uint64_t rays) {
  rays_ += rays;
  if (walked_.empty() || !worth_huge_pages(walked_bytes_, rays_, UINT64_MAX)) return;
  if (worth_huge_pages(walked_bytes_, rays_, available_memory())) copy_walked();
  walked_.clear();
}

/// Copies them into huge pages and binds the copies.
void DeviceScene::copy_walked() {
  for (const WalkedArray& array : walked_) {
    const std::shared_ptr<const std::byte> copy = copy_in_huge_pages(array.bytes);
    if (copy == nullptr) return;
    std::unique_ptr<Buffer> buffer = queue_.lend({copy.get(), array.bytes.size()}, copy);
    if (&array == &walked_.front()) {
      bindings_->bind_wide_tree(*buffer, plan_.bytes.at(BIND_DATA_POOL) / sizeof(uvec4));
      wide_nodes_ = std::move(buffer);
      continue;
    }
    PagedBuffer& pool = pools_[array.binding - BIND_POOLS];
    pool = PagedBuffer(std::move(buffer));
    bindings_->bind(array.binding, pool);
  }
}

/// Learns all of a scene but its pools.
void DeviceScene::plan(const Scene& scene, const PoolRequest& request) {
  shows_look_ = false;
  clip_content_ = clip_content(scene.clip_pool);
  leans_ = any_leans(scene.field_pool);
  plan_ = PoolPlan(device_.limits(), scene, request);
  outline_ = {};
  if (queue_.walks_wide_tree()) outline_.mapping = scene.mapping;  // elsewhere pools are copies
  outline_.root = scene.root;
  outline_.bounds_min_world = scene.bounds_min_world;
  outline_.bounds_max_world = scene.bounds_max_world;
  object_count_ = scene.materials.size();
  bindings_ = queue_.make_bindings(plan_.paging);
}

void DeviceScene::show(const Look& look) {
  const bool all = !shows_look_;
  shows_look_ = false;  // should an Error fly
  bool other_light = all || look.lights != shown_.lights || look.emitters != shown_.emitters;
  if (all || !same_bytes(look.materials, shown_.materials)) {
    show_materials(look.materials);
    std::vector<bool> two_sided = two_sided_objects(look.materials);
    other_light = other_light || two_sided != two_sided_;
    two_sided_ = std::move(two_sided);
  }
  if (other_light) show_lights(look);
  if (look.environment != shown_.environment)
    show_environment(look.environment ? *look.environment : Environment{});
  outline_.up = look.up;
  shown_ = look;
  shows_look_ = true;
}

void DeviceScene::show_materials(const std::vector<Material>& materials) {
  if (materials.size() != object_count_)
    throw Error(ExitCode::failed, "found a look of " + std::to_string(materials.size()) +
                                      " objects, expected the scene's " + std::to_string(object_count_));
  material_content_ = material_content(materials, plan_.texture_features);
  queue_.reserve(material_buffer_, std::span(materials).size_bytes());
  queue_.upload(*material_buffer_, std::as_bytes(std::span(materials)));
}

void DeviceScene::show_lights(const Look& look) {
  const std::vector<SceneLight>& lights = look.lights;
  if (lights.size() > LIGHTS_MOST)
    throw Error(ExitCode::failed, "found " + std::to_string(lights.size()) + " lights, expected at most " +
                                      std::to_string(LIGHTS_MOST));
  const auto sized = static_cast<std::uint32_t>(std::count_if(lights.begin(), lights.end(), is_sized));
  if (sized > LIGHTS_SIZED_MOST)
    throw Error(ExitCode::failed, "found " + std::to_string(sized) +
                                      " lights that have a size, expected at most " +
                                      std::to_string(LIGHTS_SIZED_MOST));
  lights_ = static_cast<std::uint32_t>(lights.size());
  lights_sized_ = sized;
  light_irradiance_ = summed_irradiance(outline_, lights) + emitted_irradiance(outline_, look.emitters);
  std::vector<Light> table = lights_in_root(outline_, lights);
  lights_met_ = static_cast<std::uint32_t>(std::count_if(table.begin(), table.end(), is_met));
  tree_ = light_tree(table, look.emitters, two_sided_);
  queue_.reserve(light_buffer_, std::span(table).size_bytes());
  queue_.upload(*light_buffer_, std::as_bytes(std::span(table)));
  upload_tree(look.emitters);
}

/// The light tree, then the words of emitters.
void DeviceScene::upload_tree(const Emitters& emitters) {
  std::vector<uvec4> texels(LIGHT_NODE_TEXELS * tree_.nodes.size());
  if (!texels.empty()) std::memcpy(texels.data(), tree_.nodes.data(), std::span(tree_.nodes).size_bytes());
  if (emitters)
    for (const Emitter& emitter : *emitters) texels.push_back(emitter.words);
  queue_.reserve(tree_buffer_, std::span(texels).size_bytes());
  queue_.upload(*tree_buffer_, std::as_bytes(std::span(texels)));
  tree_nodes_ = static_cast<std::uint32_t>(tree_.nodes.size());
  release(tree_.nodes);
}

void DeviceScene::show_environment(const Environment& environment) {
  const std::uint32_t most = device_.limits().texture_size;
  if (environment.width > most || environment.height > most)
    throw Error(ExitCode::out_of_memory, "the environment has " + std::to_string(environment.width) + "x" +
                                             std::to_string(environment.height) +
                                             " pixels, the device takes at most " + std::to_string(most) +
                                             "x" + std::to_string(most));
  environment_ = queue_.make_texture(environment.texels.empty() ? BLACK : environment);
  environment_texture_ = !environment.texels.empty();
  environment_constant_ = environment.constant;
  irradiance_ = irradiance_coefficients(environment);
  sky_ = sky_table(environment);
  upload_tables(sky_);
  release(sky_.words);
}

/// What path tracing reads beside the scene.
void DeviceScene::upload_tables(const SkyTable& sky) {
  std::vector<std::uint32_t> words;
  for (const float albedo : ALBEDO_TABLE) words.push_back(std::bit_cast<std::uint32_t>(albedo));
  words.insert(words.end(), sky.words.begin(), sky.words.end());
  queue_.reserve(table_buffer_, std::span(words).size_bytes());
  queue_.upload(*table_buffer_, std::as_bytes(std::span(words)));
}

void DeviceScene::bind() {
  for (std::uint32_t i = 0; i < pools_.size(); ++i) bindings_->bind(BIND_POOLS + i, pools_[i]);
  bindings_->bind(BIND_MATERIALS, *material_buffer_);
  bindings_->bind(BIND_LIGHTS, *light_buffer_);
  bindings_->bind(BIND_LIGHT_TABLES, *table_buffer_);
  bindings_->bind(BIND_LIGHT_TREE, *tree_buffer_);
  bindings_->bind(*environment_);
}

void DeviceScene::require_whole() const {
  if (outline_.mapping) outline_.mapping->require_whole();
}

PoolBytes DeviceScene::bytes() const {
  PoolBytes bytes = plan_.bytes;
  bytes.environment = environment_->size();
  if (wide_nodes_) bytes.at(BIND_DATA_POOL) += wide_nodes_->size();
  return bytes;
}

SceneContent DeviceScene::content() const {
  return {.materials = material_content_,
          .pools = plan_.features & (clip_content_.lines ? ~0U : ~FEATURE_CLIPS),
          .ellipses = clip_content_.ellipses,
          .leans = leans_,
          .references = plan_.references,
          .top_levels = plan_.top_levels,
          .pages = plan_.paging.pages,
          .page_shift = plan_.paging.page_shift,
          .textures = plan_.texture_features,
          .lights = lights_ > 0,
          .sized_lights = lights_sized_ > 0,
          .environment_texture = environment_texture_,
          .sky = sky_.width > 0,
          .fused = queue_.fuses()};
}

FrameParams DeviceScene::picture_params(const View& view, const Settings& settings) const {
  FrameParams frame = make_frame_params(outline_, view, settings);
  const bool traces = look_style(settings.look).paths;
  const bool mirrors = settings.look == LOOK_PAPER && (material_content_.mirrors || material_content_.glass);
  if (!traces && !mirrors) frame.max_bounces = 0;
  frame.light_end = lights_;
  frame.loop_probe = LOOP_PROBE;
  set_media(frame, shown_.materials);
  frame.lights_sized = lights_sized_;
  frame.lights_met = lights_met_;
  frame.light_nodes = tree_nodes_;
  frame.emitters = shown_.emitters ? static_cast<std::uint32_t>(shown_.emitters->size()) : 0;
  frame.nodes_sized_begin = tree_.sized_begin;
  frame.nodes_sized_end = tree_.sized_end;
  set_sky(settings, frame);
  frame.environment =
      settings.environment_strength * (environment_texture_ ? glm::vec3(1.0F) : environment_constant_);
  for (std::size_t i = 0; i < irradiance_.size(); ++i)
    frame.irradiance[i] = glm::vec4(settings.environment_strength * irradiance_[i], 0.0F);
  return frame;
}

/// The environment is chosen as often as its light's share of all is, but neither it nor the lights less than one time in ten.
void DeviceScene::set_sky(const Settings& settings, FrameParams& frame) const {
  if (sky_.width == 0 || !look_style(settings.look).paths) return;
  const double sky = sky_.irradiance_mean * settings.environment_strength;
  const double share = std::clamp(sky / std::max(sky + light_irradiance_, 1e-30), 0.1, 0.9);
  frame.sky_width = sky_.width;
  frame.sky_height = sky_.height;
  frame.sky_share = tree_nodes_ == 0 ? 1.0F : static_cast<float>(share);
}

FrameParams DeviceScene::query_params(const Settings& settings) const {
  FrameParams frame{};
  frame.tile_height = frame.height = 1;
  frame.kappa = settings.kappa;
  frame.root_unit_world = static_cast<float>(outline_.root.unit_world);
  frame.delta = static_cast<float>(settings.delta_world / outline_.root.unit_world);
  set_region(outline_.root, settings.region, frame);
  return frame;
}

}  // namespace splatray
