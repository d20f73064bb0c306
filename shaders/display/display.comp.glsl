#version 450
#extension GL_GOOGLE_include_directive : require
// What a screen takes of a picture that is traced: the mean of its samples through exposure and tone curve or, of LOOK_SEEN, colours
// as they are, shaded by their distances and as bright as the picture at rest.
#include "display/display_layout.h"
#include "display/eye_dome.glsl"
#include "display/tone.glsl"

layout(local_size_x = GROUP_SIZE) in;

layout(constant_id = DISPLAY_SPEC_STEP) const uint STEP = DISPLAY_PLAIN;
layout(constant_id = DISPLAY_SPEC_TONE) const uint TONE = DISPLAY_TONE_TABLE;

layout(std430, binding = DISPLAY_BIND_PARAMS) readonly buffer Params { DisplayParams params; };
layout(std430, binding = DISPLAY_BIND_MEANS) readonly buffer Means { vec4 means[]; };
layout(std430, binding = DISPLAY_BIND_BEFORE) readonly buffer Before { vec4 before[]; };
layout(std430, binding = DISPLAY_BIND_CURVES) readonly buffer Curves { uint curves[]; };
layout(std430, binding = DISPLAY_BIND_STATE) buffer State { uint state[]; };
layout(std430, binding = DISPLAY_BIND_PIXELS) buffer Pixels { uint pixels[]; };

const float MOST_GAIN = 4.0f;  ///< and its inverse: beyond, the picture at rest shows something else

/// The mean of all samples.
vec4 mean_at(uint i) {
  vec4 last = means[i];
  if (last.w < 0.0f) atomicOr(state[DISPLAY_CUT], 1u);
  if (params.samples_before == 0u) return last;
  uint samples = params.samples + (i / params.width < params.next_row ? 1u : 0u);
  float share = float(samples) / float(samples + params.samples_before);
  return mix(before[i], last, share);
}

/// A table's byte of a float.
uint byte_of(uint table, float value) {
  uint place = floatBitsToUint(value) >> DISPLAY_DROPPED_BITS;
  return curves[table + (place >> 2u)] >> (8u * (place & 3u)) & 255u;
}
uvec3 bytes_of(uint table, vec3 value) {
  return uvec3(byte_of(table, value.x), byte_of(table, value.y), byte_of(table, value.z));
}
uint packed(uvec3 bytes) { return bytes.x | bytes.y << 8u | bytes.z << 16u | 255u << 24u; }

/// Through exposure and tone curve.
uvec3 displayed(vec3 radiance) {
  if (TONE == DISPLAY_TONE_TABLE) return bytes_of(0u, radiance);
  vec3 color = tone_usable(params.factor * radiance);
  return bytes_of(0u, TONE == DISPLAY_TONE_AGX ? tone_agx(color) : tone_neutral(color));
}

/// The shade of a pixel of LOOK_SEEN, whose fourth component is a distance.
float dome_at(uint i) {
  float own = dome_level(means[i].w, params.per_world);
  if (own == INFINITY_F) return 1.0f;
  int x = int(i % params.width);
  int y = int(i / params.width);
  float behind = 0.0f;
  for (int beside_y = max(y - 1, 0); beside_y < min(y + 2, int(params.height)); ++beside_y)
    for (int beside_x = max(x - 1, 0); beside_x < min(x + 2, int(params.width)); ++beside_x)
      behind += dome_step(own, dome_level(means[uint(beside_y) * params.width + uint(beside_x)].w, params.per_world));
  return dome_factor(params.dome_exponent, behind);
}

float brightness(vec3 linear) { return 0.2126f * linear.x + 0.7152f * linear.y + 0.0722f * linear.z; }
float linear_of(uint byte) { return uintBitsToFloat(curves[DISPLAY_LINEAR + byte]); }

/// Adds up how bright some pixels are that show something: those of a thread, DISPLAY_SUMMED at most.
void add_brightness(uint first, uint stride, uint sum) {
  uint units = 0u;
  uint count = 0u;
  for (uint i = first; i < params.width * params.height; i += stride) {
    if (!(means[i].w > 0.0f)) continue;
    float bright = 0.0f;
    if (sum == DISPLAY_SUM_SEEN) {
      bright = brightness(means[i].xyz * dome_at(i));
    } else {
      uint word = pixels[i];
      bright = brightness(vec3(linear_of(word & 255u), linear_of(word >> 8u & 255u), linear_of(word >> 16u & 255u)));
    }
    units += uint(min(bright, 256.0f) * float(DISPLAY_BRIGHTNESS) + 0.5f);
    ++count;
  }
  if (count == 0u) return;
  uint low = atomicAdd(state[sum], units);
  if (low + units < low) atomicAdd(state[sum + 1u], 1u);
  atomicAdd(state[sum + 2u], count);
}

/// The mean brightness that a sum is of; 0 where no pixel shows anything.
float mean_brightness(uint sum) {
  if (state[sum + 2u] == 0u) return 0.0f;
  float all = float(state[sum + 1u]) * 4294967296.0f + float(state[sum]);
  return all / (float(DISPLAY_BRIGHTNESS) * float(state[sum + 2u]));
}

void match_gain() {
  float now = mean_brightness(DISPLAY_SUM_SEEN);
  if (state[DISPLAY_SUM_REST + 2u] == 0u || now <= 0.0f) return;
  float gain = clamp(mean_brightness(DISPLAY_SUM_REST) / now, 1.0f / MOST_GAIN, MOST_GAIN);
  state[DISPLAY_GAIN] = floatBitsToUint(gain);
}

void show(uint i) {
  vec4 mean = mean_at(i);
  uvec3 bytes = uvec3(0u);
  if (STEP == DISPLAY_SEEN && mean.w > 0.0f)
    bytes = bytes_of(DISPLAY_AS_IT_IS, uintBitsToFloat(state[DISPLAY_GAIN]) * (mean.xyz * dome_at(i)));
  else
    bytes = displayed(mean.xyz);
  pixels[i] = packed(bytes);
}

void main() {
  uint thread = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * GROUP_SIZE + gl_LocalInvocationIndex;
  uint threads = gl_NumWorkGroups.x * gl_NumWorkGroups.y * GROUP_SIZE;
  if (STEP == DISPLAY_MATCH) {
    if (thread == 0u) match_gain();
  } else if (STEP == DISPLAY_MEASURE_REST) {
    add_brightness(thread, threads, DISPLAY_SUM_REST);
  } else if (STEP == DISPLAY_MEASURE_SEEN) {
    add_brightness(thread, threads, DISPLAY_SUM_SEEN);
  } else if (thread < params.width * params.height) {
    show(thread);
  }
}
