// The GPU's side of what the other .glsl files need: specialization constants, pools, tables; engine/cpu/bindings_as_cpp.h is the
// C++ side. CPU: for CPU devices, see variants.cmake. PAGED: some pool is in several buffers. LIT: path tracing.
#ifndef SPLATRAY_BINDINGS_GLSL
#define SPLATRAY_BINDINGS_GLSL
#include "layout.h"
#ifdef LIT
#include "lang/albedo_layout.h"
#endif
#ifdef CPU
#define STAGED
#endif

layout(constant_id = SPEC_FEATURES) const uint FEATURES = 0u;
layout(constant_id = SPEC_BLEND) const uint BLEND = BLEND_WINDOW;
layout(constant_id = SPEC_KERNEL) const uint KERNEL = KERNEL_RIM;
layout(constant_id = SPEC_SIDE) const uint SIDE = SIDE_SIDE;
layout(constant_id = SPEC_FACES) const uint FACES = FACES_MIXED;
layout(constant_id = SPEC_ORDER) const uint ORDER = ORDER_Z;
layout(constant_id = SPEC_STAGE) const uint STAGE = STAGE_ALL;
layout(constant_id = SPEC_TOP_LEVELS) const uint TOP_LEVELS = 0u;
#ifdef PAGED
layout(constant_id = SPEC_PAGES) const uint PAGES = 0u;
layout(constant_id = SPEC_PAGE_SHIFT) const uint PAGE_SHIFT = 0u;
#endif

#define SPLATRAY_FEATURE(NAME, BIT) const bool NAME = (FEATURES & BIT) != 0u;
#include "scene/features.glsl"
#ifdef LIT
layout(constant_id = SPEC_LOOK) const uint LOOK = LOOK_LIT;
const bool TINTED = STRAIGHT && GLASS;
const bool WATCHES = EMISSION;
#else
const bool TINTED = GLASS;
const bool WATCHES = false;
#endif

layout(local_size_x = GROUP_SIZE) in;

// No uniform block: Mesa's lavapipe compiles a shader anew, 0.3 s and more, for other values of uniforms that a branch
// depends on, so for each camera.
#ifdef CPU
layout(std140, binding = BIND_FRAME) readonly buffer FrameBlock { FrameParams frame_block; };
FrameParams frame;

/// main() begins with it. llvmpipe reads storage buffers lane by lane, except in uniform control flow, so before any
/// branch or loop.
void read_frame() { frame = frame_block; }

/// Index of refraction in the dielectric that has this bit of a ray's mask. Not of the copy: llvmpipe would look
/// through all of an array there.
float medium_at(uint bit) { return frame_block.media[bit >> 2u][bit & 3u]; }
vec3 absorption_at(uint bit) { return frame_block.absorption[bit].xyz; }
#else
layout(std140, binding = BIND_FRAME) readonly buffer FrameBlock { FrameParams frame; };
void read_frame() {}  // a copy would take 116 registers
float medium_at(uint bit) { return frame.media[bit >> 2u][bit & 3u]; }
vec3 absorption_at(uint bit) { return frame.absorption[bit].xyz; }
#endif

layout(std430, binding = BIND_MATERIALS) readonly buffer MaterialTable { Material materials[]; };
layout(std430, binding = BIND_LIGHTS) readonly buffer LightTable { Light lights[]; };
layout(std430, binding = BIND_COUNTERS) buffer CounterTable { uint counters[COUNTER_COUNT]; };
layout(std430, binding = BIND_ACCUMULATION) buffer Accumulation { vec4 accumulation[]; };
layout(std430, binding = BIND_GROUPS) readonly buffer GroupList { uint group_list[]; };
layout(std430, binding = BIND_AOV) writeonly buffer AovTable { AovPixel aov[]; };
layout(binding = BIND_ENVIRONMENT) uniform sampler2D environment_map;
#ifdef LIT
layout(std430, binding = BIND_SURFACES) readonly buffer SurfaceTable { Surface surfaces[]; };
#else
layout(std430, binding = BIND_RAYS) readonly buffer RayTable { RayQuery rays[]; };
layout(std430, binding = BIND_HITS) writeonly buffer HitTable { RayHit hits[]; };
#endif

#ifdef PAGED
#define PAGES_OF(slot) (((PAGES >> (3u * (slot - BIND_NODE_POOL))) & 7u) + 1u)
#define ARRAY(slot) [PAGES_OF(slot)]
// By constants: not all devices let an array of buffers be indexed by anything else.
#define READ_PAGE(number, slot, READ, pool) \
  if (PAGES_OF(slot) > number && index >> PAGE_SHIFT == number) \
    return READ(pool[number], index & ((1u << PAGE_SHIFT) - 1u));
#define POOL_READER(slot, Value, reader, READ, pool) \
  Value reader(uint index) { \
    if (PAGES_OF(slot) == 1u) return READ(pool[0u], index); \
    READ_PAGE(0u, slot, READ, pool) \
    READ_PAGE(1u, slot, READ, pool) \
    READ_PAGE(2u, slot, READ, pool) \
    READ_PAGE(3u, slot, READ, pool) \
    READ_PAGE(4u, slot, READ, pool) \
    READ_PAGE(5u, slot, READ, pool) \
    READ_PAGE(6u, slot, READ, pool) \
    READ_PAGE(7u, slot, READ, pool) \
    return Value(0u); \
  }
#else
#define ARRAY(slot)
#define POOL_READER(slot, Value, reader, READ, pool) \
  Value reader(uint index) { return READ(pool, index); }
#endif
#ifdef CPU
#define READ_TEXEL(page, at) texelFetch(page, int(at))
#define READ_WORD(page, at) texelFetch(page, int(at)).x
#define POOL(slot, Block, pool, Value, reader, READ) \
  layout(binding = slot) uniform usamplerBuffer pool ARRAY(slot); \
  POOL_READER(slot, Value, reader, READ, pool)
#else
#define READ_TEXEL(page, at) page.values[at]
#define READ_WORD(page, at) page.values[at]
#define POOL(slot, Block, pool, Value, reader, READ) \
  layout(std430, binding = slot) readonly buffer Block { Value values[]; } pool ARRAY(slot); \
  POOL_READER(slot, Value, reader, READ, pool)
#endif
POOL(BIND_NODE_POOL, NodePool, node_pool, uint, node_word, READ_WORD)
POOL(BIND_BEGIN_END, BeginEnd, begin_end, uint, begin_end_at, READ_WORD)
POOL(BIND_SLAB_POOL, SlabPool, slab_pool, uint, slab_word, READ_WORD)
POOL(BIND_REFERENCE_POOL, ReferencePool, reference_pool, uint, reference_word, READ_WORD)
POOL(BIND_DATA_POOL, DataPool, data_pool, uvec4, splat_words, READ_TEXEL)
POOL(BIND_COLOR_POOL, ColorPool, color_pool, uint, color_word, READ_WORD)
POOL(BIND_FIELD_POOL, FieldPool, field_pool, uint, field_word, READ_WORD)
POOL(BIND_CLIP_POOL, ClipPool, clip_pool, uint, clip_word, READ_WORD)
POOL(BIND_TEXTURE_POOL, TexturePool, texture_pool, uint, texture_word, READ_WORD)
POOL(BIND_TOP_TABLE, TopTable, top_table, uint, top_entry, READ_WORD)

/// Where the data pool has the splat that a place in the leaves' lists refers to.
uint splat_at(uint place) { return REFERENCES ? reference_word(place) : place; }

Material material_at(uint object) { return materials[object]; }
Light light_at(uint index) { return lights[index]; }
#ifdef LIT
Surface surface_at(uint object) { return surfaces[object]; }
#ifdef CPU
layout(binding = BIND_LIGHT_TABLES) uniform usamplerBuffer light_tables;
layout(binding = BIND_LIGHT_TREE) uniform usamplerBuffer light_tree;
#else
layout(std430, binding = BIND_LIGHT_TABLES) readonly buffer LightTables { uint values[]; } light_tables;
layout(std430, binding = BIND_LIGHT_TREE) readonly buffer LightTree { uvec4 values[]; } light_tree;
#endif
float albedo_at(uint index) { return uintBitsToFloat(READ_WORD(light_tables, index)); }
uint sky_word(uint index) { return READ_WORD(light_tables, ALBEDO_WORDS + index); }
uvec4 light_texel(uint index) { return READ_TEXEL(light_tree, index); }
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
