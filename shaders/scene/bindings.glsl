// The GPU's side of what the other .glsl files need: specialization constants, pools, tables; engine/cpu/bindings_as_cpp.h is the
// C++ side. LIT: path tracing.
#ifndef SPLATRAY_BINDINGS_GLSL
#define SPLATRAY_BINDINGS_GLSL
#include "layout.h"
#ifdef LIT
#include "lang/albedo_layout.h"
#endif

layout(constant_id = SPEC_FEATURES) const uint FEATURES = 0u;
layout(constant_id = SPEC_BLEND) const uint BLEND = BLEND_WINDOW;
layout(constant_id = SPEC_KERNEL) const uint KERNEL = KERNEL_RIM;
layout(constant_id = SPEC_SIDE) const uint SIDE = SIDE_SIDE;
layout(constant_id = SPEC_FACES) const uint FACES = FACES_MIXED;
layout(constant_id = SPEC_ORDER) const uint ORDER = ORDER_Z;
layout(constant_id = SPEC_OUTPUT) const uint OUTPUT = OUTPUT_PICTURE;
layout(constant_id = SPEC_TOP_LEVELS) const uint TOP_LEVELS = 0u;
layout(constant_id = SPEC_PAGE_SHIFT) const uint PAGE_SHIFT = 0u;

#define SPLATRAY_FEATURE(NAME, BIT) const bool NAME = (FEATURES & BIT) != 0u;
#include "scene/features.glsl"
#ifdef LIT
layout(constant_id = SPEC_LOOK) const uint LOOK = LOOK_LIT;
const bool TINTED = STRAIGHT && GLASS;
const bool WATCHES = EMISSION;
#else
const bool TINTED = GLASS;
const bool PANES = false;
const bool WATCHES = false;
#endif

layout(local_size_x = GROUP_SIZE) in;

// No uniform block: Mesa's lavapipe compiles a shader anew, 0.3 s and more, for other values of uniforms that a branch
// depends on, so for each camera.
layout(std140, binding = BIND_FRAME) readonly buffer FrameBlock { FrameParams frame; };

/// Index of refraction in the dielectric that has this bit of a ray's mask.
float medium_at(uint bit) { return frame.media[bit >> 2u][bit & 3u]; }
vec3 absorption_at(uint bit) { return frame.absorption[bit].xyz; }
vec4 region_plane(uint index) { return frame.region[index]; }
uint region_kept() { return frame.region_kept; }
uint region_dropped() { return frame.region_dropped; }
bool region_light() { return frame.region_light != 0u; }

layout(std430, binding = BIND_MATERIALS) readonly buffer MaterialTable { Material materials[]; };
layout(std430, binding = BIND_LIGHTS) readonly buffer LightTable { Light lights[]; };
layout(std430, binding = BIND_COUNTERS) buffer CounterTable { uint counters[COUNTER_COUNT]; };
layout(std430, binding = BIND_ACCUMULATION) buffer Accumulation { vec4 accumulation[]; };
layout(std430, binding = BIND_GROUPS) readonly buffer GroupList { uint group_list[]; };
layout(std430, binding = BIND_AOV) writeonly buffer AovTable { AovPixel aov[]; };
layout(binding = BIND_ENVIRONMENT) uniform sampler2D environment_map;
#ifndef LIT
layout(std430, binding = BIND_RAYS) readonly buffer RayTable { RayQuery rays[]; };
layout(std430, binding = BIND_HITS) writeonly buffer HitTable { RayHit hits[]; };
#endif

#define ARRAY_OF(number, name, Value, pages) \
  layout(std430, binding = number) readonly buffer name##_block { Value values[]; } name pages;

// A page is found by constants: not all devices let an array of buffers be indexed by anything else. Of a pool in one buffer nothing
// but that buffer's read is left once its pipeline is built. An index behind the array's end is not even in text that never runs.
#define READ_PAGE(number, pool) \
  if (pool##_more >= number && index >> PAGE_SHIFT == number) \
    return pool[pool##_more >= number ? number : 0u].values[index & ((1u << PAGE_SHIFT) - 1u)];
#define SPLATRAY_POOL(place, NAME, pool, Value, reader, ABOUT) \
  layout(constant_id = SPEC_PAGES + place) const uint pool##_more = 0u; \
  ARRAY_OF(BIND_##NAME, pool, Value, [pool##_more + 1u]) \
  Value reader(uint index) { \
    READ_PAGE(1u, pool) \
    READ_PAGE(2u, pool) \
    READ_PAGE(3u, pool) \
    READ_PAGE(4u, pool) \
    READ_PAGE(5u, pool) \
    READ_PAGE(6u, pool) \
    READ_PAGE(7u, pool) \
    return pool[0u].values[index]; \
  }
#include "pools.glsl"

/// Where the data pool has the splat that a place in the leaves' lists refers to.
uint splat_at(uint place) { return REFERENCES ? reference_word(place) : place; }

Material material_at(uint object) { return materials[object]; }
Light light_at(uint index) { return lights[index]; }
#ifdef LIT
ARRAY_OF(BIND_LIGHT_TABLES, light_tables, uint, )
ARRAY_OF(BIND_LIGHT_TREE, light_tree, uvec4, )
float albedo_at(uint index) { return uintBitsToFloat(light_tables.values[index]); }
uint sky_word(uint index) { return light_tables.values[ALBEDO_WORDS + index]; }
uvec4 light_texel(uint index) { return light_tree.values[index]; }
#endif

/// Where splats must face to be there at all (FACES_CUT), root space.
vec3 cut_eye() { return frame.cut_eye; }

vec3 environment_texel(vec2 position) { return textureLod(environment_map, position, 0.0f).xyz; }

/// Linear colour of a splat; square-root encoded in the pool.
vec3 color_at(uint index) {
  vec3 root = unpackUnorm4x8(color_word(index)).xyz;
  return root * root;
}

uint group_number() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }

void count(uint counter, uint amount) {
  if (amount != 0u) atomicAdd(counters[counter], amount);
}

#endif
