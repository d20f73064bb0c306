#include "tests/bench/measure/scale_features.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>

#include "engine/file/scene_file.h"
#include "engine/scene/splat.h"
#include "tests/bench/cases/case_file.h"
#include "tests/bench/cases/scale_cases.h"
#include "tests/bench/measure/speed_record.h"
#include "tests/bench/measure/warm_up.h"
#include "tests/gpu/shown_tracer.h"

namespace splatray::testing {
namespace {

constexpr std::size_t FEATURE_ROUNDS = 25;
constexpr vec3 RADIANCE(0.5F);      // of the environment
constexpr double CLOSER = 1.45;     // the sphere then fills the picture's corners
constexpr double CAP_HEIGHT = 0.8;  // of the far side's object: farther than this from the centre, radii

/// Which arrays of the scene are on the device.
enum class Pools { default_, one_object, halves, flat, flat_fields, white, colored };

enum class Surroundings { constant, even_texture, studio };

/// One line of the table.
struct Entry {
  std::string feature, use;
  Pools pools = Pools::default_;
  Material near, far;  ///< of what is in view, and of the cap behind
  std::vector<SceneLight> lights{};
  Surroundings surroundings = Surroundings::constant;
  bool shadows = false;
};

Material mirror() {
  Material material = scale_material();
  material.phong.mirror = 0.9F;
  return material;
}

Material glass() {
  Material material = scale_material();
  material.ior = 1.5F;
  material.flags = MATERIAL_DIELECTRIC;
  return material;
}

Material one_sided() {
  Material material = scale_material();
  material.flags = 0;
  return material;
}

/// Each feature absent, unused and used. `key` lights what is in view, `behind` does not.
std::vector<Entry> entries_of(const SceneLight& key, const SceneLight& behind) {
  const Material base = scale_material();
  return {
      {"lights", "absent", Pools::default_, base, base},
      {"lights", "unused", Pools::default_, base, base, {behind}},
      {"lights", "used", Pools::default_, base, base, {key}},
      {"shadows", "absent", Pools::default_, base, base, {behind}},
      {"shadows", "unused", Pools::default_, base, base, {behind}, Surroundings::constant, true},
      {"shadows", "used", Pools::default_, base, base, {key}, Surroundings::constant, true},
      {"mirrors", "absent", Pools::default_, base, base},
      {"mirrors", "unused", Pools::default_, base, mirror()},
      {"mirrors", "used", Pools::default_, mirror(), base},
      {"glass", "absent", Pools::default_, base, base},
      {"glass", "unused", Pools::default_, base, glass()},
      {"glass", "used", Pools::one_object, glass(), base},
      {"environment texture", "absent", Pools::default_, base, base},
      {"environment texture", "unused", Pools::default_, base, base, {}, Surroundings::even_texture},
      {"environment texture in a mirror", "absent", Pools::default_, mirror(), base},
      {"environment texture in a mirror", "used", Pools::default_, mirror(), base, {}, Surroundings::studio},
      {"colours", "absent", Pools::default_, base, base},
      {"colours", "unused", Pools::white, base, base},
      {"colours", "used", Pools::colored, base, base},
      {"second object", "absent", Pools::one_object, base, base},
      {"second object", "unused", Pools::default_, base, base},
      {"second object", "used", Pools::halves, base, base},
      {"one- and two-sided objects", "absent", Pools::default_, base, base},
      {"one- and two-sided objects", "unused", Pools::default_, base, one_sided()},
      {"one- and two-sided objects", "used", Pools::default_, one_sided(), base},
      {"normal fields", "absent", Pools::flat, base, base},
      {"normal fields", "unused", Pools::flat_fields, base, base},
      {"normal fields", "used", Pools::default_, base, base},
  };
}

/// Gives every splat the object that `object_of` names for its centre, world space.
template <class ObjectOf>
void set_objects(Scene& scene, const ObjectOf& object_of) {
  for (uvec4& words : scene.data_pool.edit()) {
    const std::uint32_t object = object_of(scene.root.to_world(unpack_splat(words).center));
    words.w = (words.w & ~OBJECT_MASK) | object;
  }
}

/// Colours that differ from splat to splat.
void set_colors(Scene& scene) {
  scene.color_pool.edit().clear();
  for (const uvec4& words : scene.data_pool)
    scene.color_pool.edit().push_back(pack_color(0.5F + 0.5F * vec3(unpack_splat(words).normal)));
}

/// A copy of the sphere, whose default is two objects: what `forward` (unit, the view's direction) sees, and a cap behind.
Scene with_pools(Scene scene, Pools pools, const glm::dvec3& forward) {
  const glm::dvec3 across = glm::normalize(glm::cross(forward, {0.3, 1.0, 0.2}));
  scene.materials.assign(2, scale_material());
  scene.object_names = {"near", "far"};
  set_objects(scene, [&](const glm::dvec3& center) {
    if (pools == Pools::one_object) return 0U;
    if (pools == Pools::halves) return glm::dot(center, across) > 0.0 ? 1U : 0U;
    return glm::dot(center, forward) > CAP_HEIGHT ? 1U : 0U;
  });
  if (pools == Pools::flat) scene.field_pool.edit().clear();
  if (pools == Pools::flat_fields)
    std::fill(scene.field_pool.edit().begin(), scene.field_pool.edit().end(), FIELD_FLAT);
  if (pools == Pools::white) scene.color_pool.edit().assign(scene.data_pool.size(), pack_color(vec3(1.0F)));
  if (pools == Pools::colored) set_colors(scene);
  return scene;
}

/// A texture that shows what the constant environment does.
Environment even_texture(Environment like) {
  std::fill(like.texels.begin(), like.texels.end(), RADIANCE);
  return like;
}

/// The sphere with every set of pools, and the view of it.
class Stage {
 public:
  Stage(const Device& device, const Case& one, const std::filesystem::path& folder) {
    const PreparedCase prepared = read_case(folder);
    const Scene scene = read_scene(folder / file_name(one.runs.front().variant));
    view_ = {prepared.camera, one.width, one.height};
    const double half = view_.camera.fov_y_deg * std::numbers::pi / 360.0;
    view_.camera.fov_y_deg = 2.0 * std::atan(std::tan(half) / CLOSER) * 180.0 / std::numbers::pi;
    key_ = scene.lights.at(0);
    behind_ = key_;
    const glm::dvec3 forward = glm::normalize(prepared.camera.target - prepared.camera.eye);
    behind_.position = forward;
    environments_[Surroundings::studio] = read_environment_file(folder / "environment.bin");
    environments_[Surroundings::even_texture] = even_texture(environments_[Surroundings::studio]);
    environments_[Surroundings::constant].constant = RADIANCE;
    splats_ = scene.data_pool.size();
    for (const Entry& entry : entries_of(key_, behind_)) {
      if (tracers_.contains(entry.pools)) continue;
      tracers_[entry.pools] = std::make_unique<ShownTracer>(device);
      tracers_[entry.pools]->upload(with_pools(scene, entry.pools, forward));
    }
  }

  [[nodiscard]] std::vector<Entry> entries() const { return entries_of(key_, behind_); }
  [[nodiscard]] std::uint64_t splats() const { return splats_; }

  Image render(const Entry& entry, bool counters, std::uint32_t samples = 1) {
    ShownTracer& tracer = *tracers_.at(entry.pools);
    const std::vector<Material> materials{entry.near, entry.far};
    tracer.set_materials(materials);
    tracer.look.lights = entry.lights;
    tracer.set_environment(environments_.at(entry.surroundings));
    Settings settings;
    settings.samples = samples;
    settings.shadows = entry.shadows;
    settings.counters = counters;
    Image image = tracer.render(view_, settings);
    stats_ = tracer.stats();
    return image;
  }
  /// Of the last render.
  [[nodiscard]] const RenderStats& stats() const { return stats_; }

 private:
  View view_;
  SceneLight key_, behind_;
  std::map<Surroundings, Environment> environments_;
  std::uint64_t splats_ = 0;
  std::map<Pools, std::unique_ptr<ShownTracer>> tracers_;
  RenderStats stats_;
};

double differs_ppm(const Image& image, const Image& reference) {
  constexpr float LEAST = 1.0F / 255.0F;
  std::size_t count = 0;
  for (std::size_t i = 0; i < image.rgba.size(); ++i) {
    const vec4 apart = glm::abs(image.rgba[i] - reference.rgba[i]);
    count += std::max({apart.x, apart.y, apart.z}) > LEAST ? 1 : 0;
  }
  return 1e6 * static_cast<double>(count) / static_cast<double>(image.rgba.size());
}

}  // namespace

std::vector<Json> measure_features(const Device& device, const Case& one,
                                   const std::filesystem::path& folder) {
  Stage stage(device, one, folder);
  const std::vector<Entry> entries = stage.entries();
  std::vector<std::vector<double>> times(entries.size());
  const auto frame_ms = [&](const Entry& entry) {
    static_cast<void>(stage.render(entry, false));
    return stage.stats().trace_ms;
  };
  for (const Entry& entry : entries) frame_ms(entry);
  warm_up([&](std::uint32_t samples) { static_cast<void>(stage.render(entries.front(), false, samples)); });
  for (std::size_t round = 0; round < FEATURE_ROUNDS; ++round)
    for (std::size_t i = 0; i < entries.size(); ++i) times[i].push_back(frame_ms(entries[i]));
  std::vector<Json> records;
  Image absent;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Image image = stage.render(entries[i], false);
    static_cast<void>(stage.render(entries[i], true));
    Run run = one.runs.front();
    run.settings.shadows = entries[i].shadows;
    Json record = start_record(one, run, stage.splats());
    add_device(record, device);
    record["feature"] = entries[i].feature;
    record["use"] = entries[i].use;
    const auto rays = static_cast<double>(stage.stats().rays());
    add_times(record["speed"], times[i], rays);
    add_work(record["speed"], stage.stats());
    record["speed"]["rays"] = rays;
    if (entries[i].use == "absent") absent = image;
    if (entries[i].use == "unused") record["error"]["differs_ppm"] = differs_ppm(image, absent);
    records.push_back(record);
  }
  return records;
}

}  // namespace splatray::testing
