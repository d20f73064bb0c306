#include "tests/trace/twin.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>

namespace splatray::testing {
namespace {

/// What bindings.glsl declares. One set a thread, so that tests may run several twins.
struct Bindings {
  const Scene* scene = nullptr;
  std::vector<Light> lights;
  const Environment* environment = nullptr;
};
thread_local Bindings bound;
thread_local Features features;
thread_local FrameParams frame;

namespace glsl {

#include "tests/trace/glsl_as_cpp.h"

#define BLEND features[SPEC_BLEND]
#define KERNEL features[SPEC_KERNEL]
#define SIDE features[SPEC_SIDE]
#define FACES features[SPEC_FACES]
#define MIRRORS features[SPEC_MIRRORS]
#define GLASS features[SPEC_GLASS]
#define COLORS features[SPEC_COLORS]
#define SHADOWS features[SPEC_SHADOWS]
#define ENVIRONMENT features[SPEC_ENVIRONMENT]
#define COUNTERS features[SPEC_COUNTERS]
#define LIGHTS features[SPEC_LIGHTS]
#define FIELDS features[SPEC_FIELDS]

uint node_word(uint index) { return bound.scene->node_pool.at(index); }
uint begin_end_at(uint index) { return bound.scene->begin_end.at(index); }
uvec4 splat_words(uint index) { return bound.scene->data_pool.at(index); }
Material material_at(uint object) { return bound.scene->materials.at(object); }
vec3 color_at(uint index) { return unpack_color(bound.scene->color_pool.at(index)); }
uint field_word(uint index) { return bound.scene->field_pool.at(index); }
Light light_at(uint index) { return bound.lights.at(index); }

vec3 environment_texel(vec3 dir) {
  const Environment& environment = *bound.environment;
  const float column = std::atan2(dir.x, -dir.z) * 0.15915494F + 0.5F;
  const float row = std::acos(glm::clamp(dir.y, -1.0F, 1.0F)) * 0.31830989F;
  const std::uint32_t x = std::min(std::uint32_t(column * float(environment.width)), environment.width - 1);
  const std::uint32_t y = std::min(std::uint32_t(row * float(environment.height)), environment.height - 1);
  return environment.texels[std::size_t(y) * environment.width + x];
}

#include "shaders/path.glsl"
#include "shaders/query.glsl"

}  // namespace glsl

std::uint32_t faces_of(const Scene& scene) {
  std::uint32_t all = MATERIAL_TWO_SIDED;
  std::uint32_t any = 0;
  for (const Material& material : scene.materials) {
    all &= material.flags;
    any |= material.flags;
  }
  if ((any & ~MATERIAL_TWO_SIDED) != 0) return FACES_MIXED;
  if (all != 0) return FACES_BOTH;
  return any == 0 ? FACES_FRONT : FACES_MIXED;
}

void add_counters(const glsl::PathResult& path, const glsl::Tally& tally, bool finite,
                  std::array<std::uint64_t, COUNTER_COUNT>& counters) {
  counters[COUNT_PRIMARY] += 1;
  counters[COUNT_SHADOW] += path.shadow;
  counters[COUNT_REFLECTED] += path.reflected;
  counters[COUNT_REFRACTED] += path.refracted;
  counters[COUNT_LEAVES] += tally.leaves;
  counters[COUNT_NODE_STEPS] += tally.node_steps;
  counters[COUNT_TESTS] += tally.tests;
  counters[COUNT_HITS] += path.coverage > 0.0F ? 1 : 0;
  counters[COUNT_LOST] += tally.lost;
  counters[COUNT_LEAKED] += path.leaked;
  counters[COUNT_NON_FINITE] += finite ? 0 : 1;
  counters[COUNT_BOUNCE_LIMIT] += path.cut;
  counters[COUNT_ENERGY_LOST] += std::uint64_t(path.energy_lost * 1024.0F + 0.5F);
}

}  // namespace

Features twin_features(const Scene& scene, const Settings& settings) {
  Features chosen{};
  chosen[SPEC_BLEND] = settings.blend;
  chosen[SPEC_KERNEL] = settings.kernel;
  chosen[SPEC_SIDE] = settings.side;
  chosen[SPEC_FACES] = faces_of(scene);
  chosen[SPEC_MIRRORS] = 1;
  chosen[SPEC_GLASS] = 1;
  chosen[SPEC_COLORS] = scene.color_pool.empty() ? 0 : 1;
  const bool blends = settings.blend == BLEND_WINDOW || settings.blend == BLEND_NEAREST;
  chosen[SPEC_FIELDS] = blends && !scene.field_pool.empty() ? 1 : 0;
  chosen[SPEC_SHADOWS] = settings.shadows ? 1 : 0;
  chosen[SPEC_ENVIRONMENT] = 0;
  chosen[SPEC_COUNTERS] = 1;
  chosen[SPEC_LIGHTS] = 1;
  return chosen;
}

std::vector<RayHit> twin_intersect(const Scene& scene, std::span<const RayQuery> rays,
                                   const Settings& settings) {
  bound = {&scene, {}, nullptr};
  features = twin_features(scene, settings);
  std::vector<RayHit> hits;
  hits.reserve(rays.size());
  glsl::Tally tally{};
  const float delta = float(settings.delta_world / scene.root.unit_world);
  for (const RayQuery& ray : rays) hits.push_back(glsl::answer_query(ray, settings.kappa, delta, tally));
  return hits;
}

Image twin_render(const Scene& scene, const FrameParams& params, const Settings& settings,
                  const Environment& environment, std::array<std::uint64_t, COUNTER_COUNT>& counters) {
  bound = {&scene, lights_in_root(scene, scene.lights), &environment};
  features = twin_features(scene, settings);
  features[SPEC_ENVIRONMENT] = environment.width > 0 ? 1 : 0;
  frame = params;
  Image image{frame.width, frame.height, {}, {}};
  for (std::uint32_t y = 0; y < frame.height; ++y) {
    for (std::uint32_t x = 0; x < frame.width; ++x) {
      vec4 sum(0.0F);
      for (std::uint32_t s = frame.sample_begin; s < frame.sample_end; ++s) {
        const vec2 at = vec2(float(x), float(y)) + glsl::pixel_sample(s);
        float eye_distance = 0.0F;
        const glsl::Ray ray = glsl::primary_ray(at.x, at.y, eye_distance);
        glsl::Tally tally{};
        const glsl::PathResult path = glsl::trace_path(ray, y * frame.width + x, s, tally);
        const bool finite = std::isfinite(path.radiance.x + path.radiance.y + path.radiance.z);
        add_counters(path, tally, finite, counters);
        sum += vec4(finite ? path.radiance : vec3(1.0F, 0.0F, 1.0F), path.coverage);
      }
      image.rgba.push_back(sum / float(frame.sample_end - frame.sample_begin));
    }
  }
  return image;
}

}  // namespace splatray::testing
