// The pixels of a dispatch, and the running mean of each one's samples. Needs bindings.glsl.
#ifndef SPLATRAY_PIXELS_GLSL
#define SPLATRAY_PIXELS_GLSL
#include "lang/random.glsl"
#ifdef LIT
#include "lang/sobol.glsl"
#endif
#include "light/camera.glsl"
#include "light/environment.glsl"

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

/// Whether this thread has a pixel; which, in the tile.
bool find_pixel(OUT(uvec2) in_tile) {
  uint group = group_number();
  in_tile = tile_pixel(group_list[min(group, frame.group_count - 1u)]);
  return group < frame.group_count && in_tile.x < frame.tile_width && in_tile.y < frame.tile_height;
}

Ray center_ray(uvec2 pixel, OUT(float) eye_distance) {
  return primary_ray(float(pixel.x) + 0.5f, float(pixel.y) + 0.5f, eye_distance);
}

#ifdef LIT
Ray sample_ray(uvec2 pixel, uint sample_index) {
  vec4 random = sobol_sample(pixel.y * frame.width + pixel.x, sample_index, 0u, frame.seed);
  vec2 at = vec2(pixel) + (LOOK == LOOK_SEEN ? vec2(0.5f) : vec2(random));
  float eye_distance = 0.0f;
  Ray ray = primary_ray(at.x, at.y, eye_distance);
  if (LENS) ray = through_lens(ray, eye_distance, vec2(random.z, random.w));
  return ray;
}
#else
Ray sample_ray(uvec2 pixel, uint sample_index) {
  vec2 at = vec2(pixel) + pixel_sample(sample_index);
  float eye_distance = 0.0f;
  return primary_ray(at.x, at.y, eye_distance);
}
#endif

#ifdef LIT
/// Where the accumulation holds the base colours of a pixel whose mean is at `place`: behind the means of the tile, which are its first.
uint albedo_place(uint place) { return frame.tile_width * frame.tile_height + place; }
#endif

/// The mean of a pixel's samples so far, from FrameParams.mean_begin on.
vec4 mean_before(uint place) {
  return frame.sample_begin == frame.mean_begin && frame.light_begin == 0u ? vec4(0.0f) : accumulation[place];
}

/// The mean of a pixel's samples with one more, or with more of the light of the last one (FrameParams.light_begin). What is not
/// finite shows as magenta.
vec4 add_to_mean(vec4 mean, vec3 radiance, float coverage, uint sample_index) {
  float brightest = max(radiance.x, max(radiance.y, radiance.z));
  bool finite = brightest < INFINITY_F && radiance.x + radiance.y + radiance.z >= 0.0f;
  if (COUNTERS) count(COUNT_NON_FINITE, finite ? 0u : 1u);
  vec4 value = vec4(finite ? radiance : vec3(1.0f, 0.0f, 1.0f), coverage);
  // A mean, not a sum: float32 would lose small samples beside a large sum.
  vec4 change = frame.light_begin == 0u ? value - mean : vec4(vec3(value), 0.0f);
  return mean + change / float(sample_index - frame.mean_begin + 1u);
}

#endif
