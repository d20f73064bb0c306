#version 450
#extension GL_GOOGLE_include_directive : require
// A tile of the picture: for each pixel and sample, camera -> path -> accumulation; or, with AOV, what the
// centre ray hits. STAGED: a stage of the paths of one sample (queue.glsl).
#include "scene/bindings.glsl"
#ifdef EMPTY
#include "stage/empty.glsl"
#endif

layout(std430, binding = BIND_LIGHTS) readonly buffer LightTable { Light lights[]; };
layout(std430, binding = BIND_ACCUMULATION) buffer Accumulation { vec4 accumulation[]; };
layout(std430, binding = BIND_GROUPS) readonly buffer GroupList { uint group_list[]; };
layout(std430, binding = BIND_AOV) writeonly buffer AovTable { AovPixel aov[]; };
layout(binding = BIND_ENVIRONMENT) uniform sampler2D environment_map;

Light light_at(uint index) { return lights[index]; }

/// Texel of the latitude-longitude picture in this direction of its own frame (engine/scene/environment.h).
vec3 environment_texel(vec3 dir) {
  float column = atan(dir.x, -dir.z) * 0.15915494f + 0.5f;
  float row = acos(clamp(dir.y, -1.0f, 1.0f)) * 0.31830989f;
  return textureLod(environment_map, vec2(column, row), 0.0f).xyz;
}

#include "light/path.glsl"
#ifdef STAGED
#include "stage/queue.glsl"
#endif

/// Even bits of a Z-order index.
uint even_bits(uint x) {
  x &= 0x55u;
  x = (x | (x >> 1u)) & 0x33u;
  return (x | (x >> 2u)) & 0x0Fu;
}

/// This thread's pixel in the tile: groups of 8 x 8 in Z-order (Goradia et al. 2010, sec. IV-A), or rows.
uvec2 tile_pixel(uint group_word) {
  uvec2 group = uvec2(group_word & 0xFFFFu, group_word >> 16u);
  uint thread = gl_LocalInvocationIndex;
  if (ORDER == ORDER_LINEAR) return uvec2(group.x * GROUP_SIZE + thread, group.y);
  return group * 8u + uvec2(even_bits(thread), even_bits(thread >> 1u));
}

/// A number that tells splats apart.
uint hash_words(uvec4 words) {
  return hash_uint(words.x ^ hash_uint(words.y ^ hash_uint(words.z ^ hash_uint(words.w))));
}

void write_aov(uvec2 pixel, uint index) {
  Tally tally = Tally(0u, 0u, 0u, 0u);
  float eye_distance = 0.0f;
  Ray ray = primary_ray(float(pixel.x) + 0.5f, float(pixel.y) + 0.5f, eye_distance);
  Hit hit = trace_nearest(ray, frame.kappa, tally);
  aov[index].normal = hit.found ? hit.normal : vec3(0.0f);
  aov[index].z = hit.found ? (hit.t + eye_distance) * frame.root_unit_world : INFINITY_F;
  aov[index].object = hit.object;
  aov[index].splat = (hash_words(hit.first) & ~1u) | (hit.front ? 1u : 0u);
  aov[index].tests = tally.tests;
  aov[index].steps = tally.node_steps;
}

/// Of one path, or of what one stage added to it.
void add_counters(Path path, Tally tally) {
  bool first = STAGE != STAGE_NEXT;
  count(COUNT_PRIMARY, first ? 1u : 0u);
  count(COUNT_SHADOW, path.shadow);
  count(COUNT_REFLECTED, path.reflected);
  count(COUNT_REFRACTED, path.refracted);
  count(COUNT_LEAVES, tally.leaves);
  count(COUNT_NODE_STEPS, tally.node_steps);
  count(COUNT_TESTS, tally.tests);
  count(COUNT_HITS, first && path.coverage > 0.0f ? 1u : 0u);
  count(COUNT_LOST, tally.lost);
  count(COUNT_LEAKED, path.leaked);
  count(COUNT_BOUNCE_LIMIT, path.cut);
  count(COUNT_ENERGY_LOST, uint(path.energy_lost * 1024.0f + 0.5f));
}

/// The mean of a pixel's samples with one more.
vec4 add_to_mean(vec4 mean, Path path, uint sample_index) {
  float brightest = max(path.radiance.x, max(path.radiance.y, path.radiance.z));
  bool finite = brightest < INFINITY_F && path.radiance.x + path.radiance.y + path.radiance.z >= 0.0f;
  if (COUNTERS == 1u) count(COUNT_NON_FINITE, finite ? 0u : 1u);
  // A mean, not a sum: float32 would lose small samples beside a large sum.
  return mean + (vec4(finite ? path.radiance : vec3(1.0f, 0.0f, 1.0f), path.coverage) - mean) / float(sample_index + 1u);
}

void add_samples(uvec2 pixel, uint index) {
  uint pixel_number = pixel.y * frame.width + pixel.x;
  uint place = frame.tile_first + index;
  vec4 mean = frame.sample_begin == 0u ? vec4(0.0f) : accumulation[place];
  uint sample_index = frame.sample_begin;
  do {
    vec2 at = vec2(pixel) + pixel_sample(sample_index);
    float eye_distance = 0.0f;
    Tally tally = Tally(0u, 0u, 0u, 0u);
    Path path = path_start(primary_ray(at.x, at.y, eye_distance));
    follow_path(path, pixel_number, sample_index, tally);
#ifdef STAGED
    if (path.alive) queue_path(path, place);
#endif
    if (!path.alive) mean = add_to_mean(mean, path, sample_index);
    if (COUNTERS == 1u) add_counters(path, tally);
    sample_index += 1u;
  } while (sample_index < frame.sample_end);
  accumulation[place] = mean;
}

#ifdef STAGED
/// The next ray of a queued path.
void go_on(uint index) {
  uint place = 0u;
  Path path = queued_path(index, place);
  uint in_tile = place - frame.tile_first;
  uint row = in_tile / frame.tile_width;
  uint column = in_tile - row * frame.tile_width;
  uint sample_index = frame.sample_begin;
  Tally tally = Tally(0u, 0u, 0u, 0u);
  follow_path(path, (frame.tile_y + row) * frame.width + frame.tile_x + column, sample_index, tally);
  if (path.alive) {
    queue_path(path, place);
  } else {
    accumulation[place] = add_to_mean(accumulation[place], path, sample_index);
  }
  if (COUNTERS == 1u) add_counters(path, tally);
}
#endif

void main() {
  read_frame();
  uint group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
#ifdef STAGED
  if (STAGE == STAGE_NEXT) {
    uint index = group * GROUP_SIZE + gl_LocalInvocationIndex;
    if (index < frame.path_count) go_on(index);
    return;
  }
#endif
  uvec2 in_tile = tile_pixel(group_list[frame.first_group + min(group, frame.group_count - 1u)]);
  if (group >= frame.group_count || in_tile.x >= frame.tile_width || in_tile.y >= frame.tile_height) return;
  uvec2 pixel = in_tile + uvec2(frame.tile_x, frame.tile_y);
  uint index = in_tile.y * frame.tile_width + in_tile.x;
  if (AOV == 1u) {
    write_aov(pixel, index);
  } else {
    add_samples(pixel, index);
  }
}
