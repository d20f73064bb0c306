#include "tests/trace/twin.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <numeric>

#include "engine/scene/clip.h"
#include "engine/scene/pool/copies.h"
#include "engine/scene/splat.h"
#include "engine/scene/texture_factors.h"
#include "engine/scene/tree.h"
#include "shaders/lang/hit_numbers.h"

namespace splatray::testing {
namespace {

/// What bindings.glsl declares. One set a thread, so that tests may run several twins.
thread_local const Scene* bound = nullptr;
thread_local Features features;
struct MadePools {
  std::vector<std::uint32_t> texture_pool, top_table;
};
thread_local MadePools made;
thread_local FrameParams region_frame;

namespace glsl {

#include "shaders/lang/glsl_as_cpp.h"

#define BLEND features[SPEC_BLEND]
#define KERNEL features[SPEC_KERNEL]
#define SIDE features[SPEC_SIDE]
#define FACES features[SPEC_FACES]
#define TOP_LEVELS features[SPEC_TOP_LEVELS]
/// Whether the twin has a feature.
template <uint BIT>
struct Feature {
  operator bool() const { return (features[SPEC_FEATURES] & BIT) != 0U; }  // NOLINT: as a bool of GLSL
};
#define SPLATRAY_FEATURE(NAME, BIT) constexpr Feature<BIT> NAME;
#include "shaders/scene/features.glsl"
#define WATCHES false
#define PANES false

/// Throws where the index is not in the pool.
template <class Value>
const Value& element_at(const Pool<Value>& pool, uint index) {
  if (index >= pool.size()) throw std::out_of_range("an index beyond a pool");
  return pool[index];
}

#define SPLATRAY_POOL(place, NAME, pool, Value, reader, ABOUT) \
  Value reader(uint index) { return element_at(bound->pool, index); }
#define SPLATRAY_MADE_POOL(place, NAME, pool, Value, reader, ABOUT) \
  Value reader(uint index) { return made.pool.at(index); }
#include "shaders/pools.glsl"

uint splat_at(uint place) { return reference_word(place); }
Material material_at(uint object) { return bound->materials.at(object); }
vec3 color_at(uint splat) { return unpack_color(color_word(splat)); }
vec3 cut_eye() { return vec3(0.0F); }
vec4 region_plane(uint index) { return region_frame.region[index]; }
uint region_kept() { return region_frame.region_kept; }
uint region_dropped() { return region_frame.region_dropped; }

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
  if (!settings.region.empty() && chosen[SPEC_FACES] == FACES_FRONT) chosen[SPEC_FACES] = FACES_BOTH;
  const bool bends = settings.blend == BLEND_WINDOW || settings.blend == BLEND_NEAREST;
  chosen[SPEC_FEATURES] = FEATURE_GLASS | FEATURE_COUNTERS |
                          (pool_counts(scene).pools & (bends ? ~0U : ~FEATURE_FIELDS)) |
                          (clip_content(scene.clip_pool).ellipses ? FEATURE_ELLIPSES : 0) |
                          (bends && any_leans(scene.field_pool) ? FEATURE_LEANS : 0) |
                          (settings.region.empty() ? 0 : FEATURE_REGION) | texture_features(scene.columns);
  chosen[SPEC_TOP_LEVELS] = 5;
  return chosen;
}

std::vector<RayHit> twin_intersect(const Scene& scene, std::span<const RayQuery> rays,
                                   const Settings& settings) {
  bound = &scene;
  features = twin_features(scene, settings);
  set_region(scene.root, settings.region, region_frame);
  made.top_table = top_table(scene, features[SPEC_TOP_LEVELS]);
  std::vector<std::uint32_t> splats(scene.data_pool.size());
  std::iota(splats.begin(), splats.end(), 0U);
  made.texture_pool = texture_words(scene.columns, splats);
  std::vector<RayHit> hits;
  hits.reserve(rays.size());
  glsl::Tally tally{};
  const float delta = float(settings.delta_world / scene.root.unit_world);
  for (const RayQuery& ray : rays) hits.push_back(glsl::answer_query(ray, settings.kappa, delta, tally));
  return hits;
}

}  // namespace splatray::testing
