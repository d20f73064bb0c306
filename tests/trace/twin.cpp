#include "tests/trace/twin.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <numeric>

#include "engine/scene/clip.h"
#include "engine/scene/splat.h"
#include "engine/scene/texture_factors.h"
#include "engine/scene/tree.h"

namespace splatray::testing {
namespace {

/// What bindings.glsl declares. One set a thread, so that tests may run several twins.
thread_local const Scene* bound = nullptr;
thread_local std::vector<std::uint32_t> top;
thread_local std::vector<std::uint32_t> textures;
thread_local Features features;

namespace glsl {

#include "shaders/lang/glsl_as_cpp.h"

#define BLEND features[SPEC_BLEND]
#define KERNEL features[SPEC_KERNEL]
#define SIDE features[SPEC_SIDE]
#define FACES features[SPEC_FACES]
#define TOP_LEVELS features[SPEC_TOP_LEVELS]
#define GLASS ((features[SPEC_FEATURES] & FEATURE_GLASS) != 0)
#define COLORS ((features[SPEC_FEATURES] & FEATURE_COLORS) != 0)
#define COUNTERS ((features[SPEC_FEATURES] & FEATURE_COUNTERS) != 0)
#define FIELDS ((features[SPEC_FEATURES] & FEATURE_FIELDS) != 0)
#define CLIPS (!bound->clip_pool.empty())
#define WATCHES false
#define OPACITY ((features[SPEC_FEATURES] & FEATURE_OPACITY) != 0)
#define TEXTURE_LAYER ((features[SPEC_FEATURES] & FEATURE_TEXTURE_LAYER) != 0)
#define TEXTURE_GLOW ((features[SPEC_FEATURES] & FEATURE_TEXTURE_GLOW) != 0)
#define TEXTURE_COLOR ((features[SPEC_FEATURES] & FEATURE_TEXTURE_COLOR) != 0)
#define TEXTURE_NORMAL ((features[SPEC_FEATURES] & FEATURE_TEXTURE_NORMAL) != 0)
#define ELLIPSES ((features[SPEC_FEATURES] & FEATURE_ELLIPSES) != 0)

uint top_entry(uint index) { return top.at(index); }
uint texture_word(uint index) { return textures.at(index); }
uint node_word(uint index) { return bound->node_pool.at(index); }
uint begin_end_at(uint index) { return bound->begin_end.at(index); }
uint slab_word(uint index) { return bound->slab_pool.at(index); }
uint splat_at(uint place) { return bound->reference_pool.at(place); }
uvec4 splat_words(uint splat) { return bound->data_pool.at(splat); }
Material material_at(uint object) { return bound->materials.at(object); }
vec3 color_at(uint splat) { return unpack_color(bound->color_pool.at(splat)); }
uint field_word(uint splat) { return bound->field_pool.at(splat); }
vec3 cut_eye() { return vec3(0.0F); }
uint clip_word(uint splat) { return bound->clip_pool.at(splat); }

#include "shaders/stage/query.glsl"

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

}  // namespace

Features twin_features(const Scene& scene, const Settings& settings) {
  Features chosen{};
  chosen[SPEC_BLEND] = settings.blend;
  chosen[SPEC_KERNEL] = settings.kernel;
  chosen[SPEC_SIDE] = settings.side;
  chosen[SPEC_FACES] = faces_of(scene);
  const bool bends = settings.blend == BLEND_WINDOW || settings.blend == BLEND_NEAREST;
  chosen[SPEC_FEATURES] = FEATURE_GLASS | FEATURE_COUNTERS | (scene.color_pool.empty() ? 0 : FEATURE_COLORS) |
                          (bends && !scene.field_pool.empty() ? FEATURE_FIELDS : 0) |
                          (clip_content(scene.clip_pool).ellipses ? FEATURE_ELLIPSES : 0) |
                          texture_features(scene.columns);
  chosen[SPEC_TOP_LEVELS] = 5;
  return chosen;
}

std::vector<RayHit> twin_intersect(const Scene& scene, std::span<const RayQuery> rays,
                                   const Settings& settings) {
  bound = &scene;
  features = twin_features(scene, settings);
  top = top_table(scene, features[SPEC_TOP_LEVELS]);
  std::vector<std::uint32_t> splats(scene.data_pool.size());
  std::iota(splats.begin(), splats.end(), 0U);
  textures = texture_words(scene.columns, splats);
  std::vector<RayHit> hits;
  hits.reserve(rays.size());
  glsl::Tally tally{};
  const float delta = float(settings.delta_world / scene.root.unit_world);
  for (const RayQuery& ray : rays) hits.push_back(glsl::answer_query(ray, settings.kappa, delta, tally));
  return hits;
}

}  // namespace splatray::testing
