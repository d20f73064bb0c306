// The GPU's side of what the other .glsl files need: features (specialization constants), pools, tables,
// environment. POOL_TEXEL: the pools are texel buffers, else storage buffers.
#ifndef SPLATRAY_BINDINGS_GLSL
#define SPLATRAY_BINDINGS_GLSL
#include "layout.h"

layout(constant_id = SPEC_BLEND) const uint BLEND = BLEND_WINDOW;
layout(constant_id = SPEC_KERNEL) const uint KERNEL = KERNEL_RIM;
layout(constant_id = SPEC_SIDE) const uint SIDE = SIDE_SIDE;
layout(constant_id = SPEC_FACES) const uint FACES = FACES_MIXED;
layout(constant_id = SPEC_MIRRORS) const uint MIRRORS = 0u;
layout(constant_id = SPEC_GLASS) const uint GLASS = 0u;
layout(constant_id = SPEC_COLORS) const uint COLORS = 0u;
layout(constant_id = SPEC_SHADOWS) const uint SHADOWS = 0u;
layout(constant_id = SPEC_ENVIRONMENT) const uint ENVIRONMENT = 0u;
layout(constant_id = SPEC_ORDER) const uint ORDER = ORDER_Z;
layout(constant_id = SPEC_COUNTERS) const uint COUNTERS = 0u;
layout(constant_id = SPEC_AOV) const uint AOV = 0u;
layout(constant_id = SPEC_LIGHTS) const uint LIGHTS = 0u;
layout(constant_id = SPEC_FIELDS) const uint FIELDS = 0u;
layout(constant_id = SPEC_REFERENCES) const uint REFERENCES = REFERENCES_NONE;
layout(constant_id = SPEC_TOP_LEVELS) const uint TOP_LEVELS = 0u;

#ifdef STAGED
layout(constant_id = SPEC_STAGE) const uint STAGE = STAGE_FIRST;
#else
const uint STAGE = STAGE_ALL;
#endif

layout(local_size_x = GROUP_SIZE) in;

// No uniform block: Mesa's lavapipe compiles a shader anew, 0.3 s and more, for other values of uniforms that a branch
// depends on, so for each camera.
layout(std140, binding = BIND_FRAME) readonly buffer FrameBlock { FrameParams frame_block; };
layout(std430, binding = BIND_MATERIALS) readonly buffer MaterialTable { Material materials[]; };
layout(std430, binding = BIND_COUNTERS) buffer CounterTable { uint counters[COUNTER_COUNT]; };

// main() begins with read_frame(). llvmpipe reads storage buffers lane by lane but where all lanes are sure to be there, so before
// any branch or loop; elsewhere 116 registers would be too many.
#ifdef FLOAT64
FrameParams frame;
void read_frame() { frame = frame_block; }
#else
#define frame frame_block
void read_frame() {}
#endif

#ifdef POOL_TEXEL
layout(binding = BIND_NODE_POOL) uniform usamplerBuffer node_pool;
layout(binding = BIND_BEGIN_END) uniform usamplerBuffer begin_end;
layout(binding = BIND_SLAB_POOL) uniform usamplerBuffer slab_pool;
layout(binding = BIND_REFERENCE_POOL) uniform usamplerBuffer reference_pool;
layout(binding = BIND_DATA_POOL) uniform usamplerBuffer data_pool;
layout(binding = BIND_COLOR_POOL) uniform usamplerBuffer color_pool;
layout(binding = BIND_FIELD_POOL) uniform usamplerBuffer field_pool;
layout(binding = BIND_TOP_TABLE) uniform usamplerBuffer top_table;
uint top_entry(uint index) { return texelFetch(top_table, int(index)).x; }
uint node_word(uint index) { return texelFetch(node_pool, int(index)).x; }
uint begin_end_at(uint index) { return texelFetch(begin_end, int(index)).x; }
uint slab_word(uint index) { return texelFetch(slab_pool, int(index)).x; }
uint reference_word(uint index) {
  if (REFERENCES == REFERENCES_ONE) return texelFetch(reference_pool, int(index)).x;
  uvec4 four = texelFetch(reference_pool, int(index >> 2u));
  uvec2 two = (index & 2u) != 0u ? four.zw : four.xy;
  return (index & 1u) != 0u ? two.y : two.x;
}
uvec4 splat_words(uint index) { return texelFetch(data_pool, int(index)); }
uint color_word(uint index) { return texelFetch(color_pool, int(index)).x; }
uint field_word(uint index) { return texelFetch(field_pool, int(index)).x; }
#else
layout(std430, binding = BIND_NODE_POOL) readonly buffer NodePool { uint node_pool[]; };
layout(std430, binding = BIND_BEGIN_END) readonly buffer BeginEnd { uint begin_end[]; };
layout(std430, binding = BIND_SLAB_POOL) readonly buffer SlabPool { uint slab_pool[]; };
layout(std430, binding = BIND_REFERENCE_POOL) readonly buffer ReferencePool { uint reference_pool[]; };
layout(std430, binding = BIND_DATA_POOL) readonly buffer DataPool { uvec4 data_pool[]; };
layout(std430, binding = BIND_COLOR_POOL) readonly buffer ColorPool { uint color_pool[]; };
layout(std430, binding = BIND_FIELD_POOL) readonly buffer FieldPool { uint field_pool[]; };
layout(std430, binding = BIND_TOP_TABLE) readonly buffer TopTable { uint top_table[]; };
uint top_entry(uint index) { return top_table[index]; }
uint node_word(uint index) { return node_pool[index]; }
uint begin_end_at(uint index) { return begin_end[index]; }
uint slab_word(uint index) { return slab_pool[index]; }
uint reference_word(uint index) { return reference_pool[index]; }
uvec4 splat_words(uint index) { return data_pool[index]; }
uint color_word(uint index) { return color_pool[index]; }
uint field_word(uint index) { return field_pool[index]; }
#endif

/// Where the data pool has the splat that a place in the leaves' lists refers to.
uint splat_at(uint place) { return REFERENCES == REFERENCES_NONE ? place : reference_word(place); }

Material material_at(uint object) { return materials[object]; }

/// Index of refraction in the dielectric that has this bit of a ray's mask. Not of the copy of the parameters: llvmpipe would
/// look through all of an array there.
float medium_at(uint bit) { return frame_block.media[bit >> 2u][bit & 3u]; }

/// Linear colour of a splat; square-root encoded in the pool.
vec3 color_at(uint index) {
  vec3 root = unpackUnorm4x8(color_word(index)).xyz;
  return root * root;
}

void count(uint counter, uint amount) {
  if (amount != 0u) atomicAdd(counters[counter], amount);
}

#endif
