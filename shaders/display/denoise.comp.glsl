#version 450
#extension GL_GOOGLE_include_directive : require
// The filter of engine/image/denoise.cpp, which says where it is from, step by step. Names and constants are those there and in
// surface_likeness.cpp and fireflies.cpp.
#include "display/denoise_layout.h"

layout(local_size_x = GROUP_SIZE) in;

layout(constant_id = DENOISE_SPEC_STEP) const uint STEP = DENOISE_FINITE;

layout(std430, binding = DENOISE_BIND_PARAMS) readonly buffer Params { DenoiseParams params; };
layout(std430, binding = DENOISE_BIND_MEANS) readonly buffer Means { vec4 means[]; };
layout(std430, binding = DENOISE_BIND_BEFORE) readonly buffer Before { vec4 before[]; };
layout(std430, binding = DENOISE_BIND_PART) buffer Part { vec4 part[]; };
layout(std430, binding = DENOISE_BIND_BASE) readonly buffer Base { vec4 base[]; };
layout(std430, binding = DENOISE_BIND_AOV) readonly buffer Aov { AovPixel aov[]; };
layout(std430, binding = DENOISE_BIND_PLANES) buffer Planes { vec4 planes[]; };
layout(std430, binding = DENOISE_BIND_WORDS) buffer Words { uint words[]; };
layout(std430, binding = DENOISE_BIND_RESULT) writeonly buffer Result { vec4 result[]; };

const float KERNEL[3] = float[](0.375f, 0.25f, 0.0625f);
const float SMALL_KERNEL[2] = float[](0.5f, 0.25f);

/// e^x, the same polynomial as there.
float decay(float x) {
  float powers = (x > -87.0f ? min(x, 0.0f) : -87.0f) * 1.442695041f;
  int whole = int(powers);
  float f = powers - float(whole);
  float terms = 0.0555041087f + f * (0.00961812911f + f * (0.00133335581f + f * 1.54035e-4f));
  return (1.0f + f * (0.693147181f + f * (0.240226507f + f * terms))) * uintBitsToFloat(uint(whole + 127) << 23u);
}

uint pixels() { return params.width * params.height; }
vec4 plane(uint which, uint i) { return planes[which * pixels() + i]; }
void set_plane(uint which, uint i, vec4 value) { planes[which * pixels() + i] = value; }
uint object_at(uint i) { return words[i]; }
bool is_surface(uint i) { return object_at(i) != NO_OBJECT; }
bool is_rim(uint i) { return words[pixels() + i] != 0u; }
float luminance(vec3 color) { return dot(color, vec3(0.2126f, 0.7152f, 0.0722f)); }

ivec2 place_of(uint i) { return ivec2(int(i % params.width), int(i / params.width)); }
bool is_inside(ivec2 place) {
  return place.x >= 0 && place.y >= 0 && place.x < int(params.width) && place.y < int(params.height);
}
uint at(ivec2 place) { return uint(place.y) * params.width + uint(place.x); }

/// By its bits: compilers may take it that there are no such numbers.
bool is_finite(float value) { return (floatBitsToUint(value) & 0x7F800000u) != 0x7F800000u; }
bool is_finite(vec4 value) {
  return is_finite(value.x) && is_finite(value.y) && is_finite(value.z) && is_finite(value.w);
}

const uint OF_PICTURE = 0u;
const uint OF_PART = 1u;
const uint OF_BASE = 2u;

/// The mean of all samples.
vec4 mean_at(uint i) {
  if (params.weight == 0.0f) return before[i];
  return params.weight < 1.0f ? mix(before[i], means[i], params.weight) : means[i];
}

/// An input's pixel, what is finite of it limited.
vec4 limited(uint input_of, uint i) {
  vec4 value = mean_at(i);
  if (input_of == OF_PART) value = part[i];
  if (input_of == OF_BASE) value = base[i];
  if (!is_finite(value)) return value;
  float most = input_of == OF_BASE ? 1.0f : DENOISE_RADIANCE_MOST;
  return vec4(clamp(value.xyz, vec3(input_of == OF_BASE ? 0.0f : -most), vec3(most)), value.w);
}

/// The same; where it is not finite the mean of the finite ones around.
vec4 finite_of(uint input_of, uint i) {
  vec4 own = limited(input_of, i);
  if (is_finite(own)) return own;
  vec4 sum = vec4(0.0f);
  float count = 0.0f;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      ivec2 beside = place_of(i) + ivec2(dx, dy);
      if (!is_inside(beside)) continue;
      vec4 other = limited(input_of, at(beside));
      if (!is_finite(other)) continue;
      sum += other;
      count += 1.0f;
    }
  return sum / max(count, 1.0f);
}

/// The object of a pixel whose normal and depth are finite.
uint finite_object(uint i) {
  AovPixel pixel = aov[i];
  return is_finite(vec4(pixel.normal, pixel.z)) ? pixel.object : NO_OBJECT;
}

/// The least of what a pixel's depth changes by towards a neighbour and `least`.
float less_slope(float least, uint i, ivec2 beside) {
  if (!is_inside(beside) || !is_finite(vec4(aov[at(beside)].normal, aov[at(beside)].z))) return least;
  return min(least, abs(aov[at(beside)].z - aov[i].z));
}
float slope(uint i, ivec2 along) {
  const float NONE = 3e38f;
  float least = less_slope(less_slope(NONE, i, place_of(i) - along), i, place_of(i) + along);
  return least < NONE ? least : 0.0f;
}

void make_finite(uint i) {
  uint object = finite_object(i);
  bool surface = object != NO_OBJECT;
  words[i] = object;
  set_plane(DENOISE_PLANE_RGBA, i, finite_of(OF_PICTURE, i));
  set_plane(DENOISE_PLANE_PART, i, finite_of(OF_PART, i));
  set_plane(DENOISE_PLANE_BASE, i, vec4(finite_of(OF_BASE, i).xyz, surface ? slope(i, ivec2(1, 0)) : 0.0f));
  set_plane(DENOISE_PLANE_SURFACE, i, surface ? vec4(aov[i].normal, aov[i].z) : vec4(0.0f));
  set_plane(DENOISE_PLANE_GUIDE, i, vec4(0.0f, 0.0f, 0.0f, surface ? slope(i, ivec2(0, 1)) : 0.0f));
}

uint pieces_of_row() { return (params.width + DENOISE_PIECE - 1u) / DENOISE_PIECE; }

void find_piece(uint piece) {
  uint row = piece / pieces_of_row();
  uint begin = piece % pieces_of_row() * DENOISE_PIECE;
  uint any = 0u;
  for (uint x = begin; x < min(begin + DENOISE_PIECE, params.width); ++x)
    if (is_surface(row * params.width + x)) any = 1u;
  words[2u * pixels() + piece] = any;
}

/// SurfaceLikeness::find of a pixel and the neighbour that lies `apart` from it; 0 where it shows no surface.
float likeness(uint i, uint tap, ivec2 apart) {
  if (apart == ivec2(0)) return 1.0f;
  if (object_at(i) != object_at(tap) || !is_surface(i)) return 0.0f;
  vec4 here = plane(DENOISE_PLANE_SURFACE, i);
  vec4 there = plane(DENOISE_PLANE_SURFACE, tap);
  float facing = clamp(dot(here.xyz, there.xyz), 0.0f, 1.0f);
  facing *= facing;
  facing *= facing;
  facing *= facing;
  facing *= facing;
  facing *= facing;
  vec4 own = plane(DENOISE_PLANE_BASE, i);
  vec3 other = plane(DENOISE_PLANE_BASE, tap).xyz;
  float down = plane(DENOISE_PLANE_GUIDE, i).w;
  float expected =
      own.w * float(abs(apart.x)) + down * float(abs(apart.y)) + 1e-4f * abs(here.w) + 1.17549435e-38f;
  vec3 paint = own.xyz - other;
  float squares = dot(own.xyz, own.xyz) + dot(other, other);
  float painted = dot(paint, paint) / (DENOISE_BASE_WIDTH * DENOISE_BASE_WIDTH * (squares + DENOISE_BASE_DARK * DENOISE_BASE_DARK));
  return facing * decay(-abs(here.w - there.w) / expected - painted);
}

vec3 base_of(uint i) { return max(plane(DENOISE_PLANE_BASE, i).xyz, vec3(DENOISE_BASE_LEAST)); }

/// Light of the first half, and of the second, as they were found.
vec3 found_half(uint i, uint which) {
  vec3 in_part = plane(DENOISE_PLANE_PART, i).xyz / base_of(i);
  if (which == 0u) return in_part;
  return (plane(DENOISE_PLANE_RGBA, i).xyz / base_of(i) - params.share * in_part) / (1.0f - params.share);
}

vec3 without_spark(uint i, uint which) {
  vec3 own = found_half(i, which);
  float most = luminance(found_half(i, 1u - which));
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      ivec2 beside = place_of(i) + ivec2(dx, dy);
      if (is_inside(beside)) most = max(most, luminance(found_half(at(beside), 1u - which)));
    }
  float bright = luminance(own);
  return bright > DENOISE_SPARK * most ? own * (DENOISE_SPARK * most / bright) : own;
}

bool find_rim(uint i) {
  ivec2 place = place_of(i);
  uint piece = uint(place.y) * pieces_of_row() + uint(place.x) / DENOISE_PIECE;
  if (words[2u * pixels() + piece] == 0u) return false;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      ivec2 beside = place + ivec2(dx, dy);
      if (is_inside(beside) && likeness(i, at(beside), ivec2(dx, dy)) < DENOISE_RIM_LIKENESS) return true;
    }
  return false;
}

/// The pixel with this light.
vec4 joined(uint i, vec3 first, vec3 second) {
  vec4 own = plane(DENOISE_PLANE_RGBA, i);
  if (!is_surface(i)) return own;
  return vec4(mix(second, first, params.share) * base_of(i), own.w);
}

void take_apart(uint i) {
  vec3 first = without_spark(i, 0u);
  vec3 second = without_spark(i, 1u);
  bool rim = find_rim(i);
  vec3 excess = params.share * (found_half(i, 0u) - first) + (1.0f - params.share) * (found_half(i, 1u) - second);
  words[pixels() + i] = rim ? 1u : 0u;
  set_plane(DENOISE_PLANE_LIGHT, i, vec4(first, 0.0f));
  set_plane(DENOISE_PLANE_LIGHT + 1u, i, vec4(second, 0.0f));
  set_plane(DENOISE_PLANE_LIGHT + 2u, i, vec4(rim ? vec3(0.0f) : excess, 0.0f));
}

/// The picture of the light before it is filtered; and its variance, which stands behind the first half.
void find_variance(uint i) {
  vec3 first = plane(DENOISE_PLANE_LIGHT, i).xyz;
  vec3 second = plane(DENOISE_PLANE_LIGHT + 1u, i).xyz;
  set_plane(DENOISE_PLANE_PART, i, joined(i, first, second));
  uint filtered = DENOISE_PLANE_LIGHT + 3u;
  vec3 excess = plane(DENOISE_PLANE_LIGHT + 2u, i).xyz;
  float variance = 0.0f;
  if (is_surface(i)) {
    float sum = 0.0f;
    float squares = 0.0f;
    float weights = 0.0f;
    for (int dy = -3; dy <= 3; ++dy)
      for (int dx = -3; dx <= 3; ++dx) {
        ivec2 beside = place_of(i) + ivec2(dx, dy);
        if (!is_inside(beside)) continue;
        uint tap = at(beside);
        float like = likeness(i, tap, ivec2(dx, dy));
        float a = luminance(plane(DENOISE_PLANE_LIGHT, tap).xyz);
        float b = luminance(plane(DENOISE_PLANE_LIGHT + 1u, tap).xyz);
        sum += like * (0.5f * (a - b) * (a - b));
        squares += like * (0.25f * (a + b) * (a + b));
        weights += like;
      }
    float bright = luminance(first) + luminance(second);
    float square = 0.25f * bright * bright;
    float brighter = !is_rim(i) && square > 0.0f ? square / squares : 0.0f;
    variance = sum * max(1.0f / weights, brighter);
    float most = DENOISE_EXCESS_MOST * sqrt(squares / weights);
    float much = luminance(excess);
    if (much > most) excess *= most / much;
  }
  set_plane(filtered, i, vec4(first, variance));
  set_plane(filtered + 1u, i, vec4(second, 0.0f));
  set_plane(filtered + 2u, i, vec4(excess, 0.0f));
}

void find_guide(uint i) {
  vec3 sums = vec3(0.0f);  // both halves' brightness, variance
  float weights = 0.0f;
  if (is_surface(i)) {
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        ivec2 beside = place_of(i) + ivec2(dx, dy);
        if (!is_inside(beside)) continue;
        uint tap = at(beside);
        float weight = SMALL_KERNEL[abs(dx)] * SMALL_KERNEL[abs(dy)] * likeness(i, tap, ivec2(dx, dy));
        vec4 first = plane(params.light, tap);
        sums += weight * vec3(luminance(first.xyz), luminance(plane(params.light + 1u, tap).xyz), weight * first.w);
        weights += weight;
      }
    sums = vec3(sums.xy / weights, sums.z / (weights * weights));
  }
  uint place = DENOISE_PLANE_GUIDE * pixels() + i;
  planes[place] = vec4(sums, planes[place].w);
}

/// Weights of a neighbour's two halves beside likeness and kernel.
vec2 light_weights(vec3 here, vec3 there) {
  float explained = here.z + min(here.z, there.z);
  float noise = here.z + there.z;
  vec2 apart = here.xy - there.xy;
  vec2 excess = max(apart * apart - explained, vec2(0.0f));
  float by_other = 1.0f / (DENOISE_NOISE_WIDTH * DENOISE_NOISE_WIDTH * noise + 1e-12f);
  float by_own = 1.0f / (DENOISE_OWN_WIDTH * DENOISE_OWN_WIDTH * noise + 1e-12f);
  vec2 beyond = excess.yx * by_other + excess * by_own;
  return vec2(decay(-beyond.x), decay(-beyond.y));
}

void filter_pass(uint i) {
  vec4 first = plane(params.light, i);
  vec4 second = plane(params.light + 1u, i);
  vec4 excess = plane(params.light + 2u, i);
  if (is_surface(i)) {
    vec3 guide = plane(DENOISE_PLANE_GUIDE, i).xyz;
    vec4 first_sum = vec4(0.0f);
    vec3 second_sum = vec3(0.0f);
    vec3 excess_sum = vec3(0.0f);
    vec2 weights = vec2(0.0f);
    float others = 0.0f;
    int stride = int(params.stride);
    for (int dy = -2; dy <= 2; ++dy)
      for (int dx = -2; dx <= 2; ++dx) {
        ivec2 apart = stride * ivec2(dx, dy);
        ivec2 beside = place_of(i) + apart;
        if (!is_inside(beside)) continue;
        uint tap = at(beside);
        float spread = KERNEL[abs(dx)] * KERNEL[abs(dy)] * likeness(i, tap, apart);
        if (spread == 0.0f) continue;
        vec2 weight = spread * light_weights(guide, plane(DENOISE_PLANE_GUIDE, tap).xyz);
        vec4 of_first = plane(params.light, tap);
        first_sum += weight.x * vec4(of_first.xyz, weight.x * of_first.w);
        second_sum += weight.y * plane(params.light + 1u, tap).xyz;
        weights += weight;
        if (stride == 1 && dx == 0 && dy == 0) continue;  // a pixel alone loses its excess
        others += spread;
        excess_sum += spread * plane(params.light + 2u, tap).xyz;
      }
    first = vec4(first_sum.xyz / weights.x, first_sum.w / (weights.x * weights.x));
    second.xyz = second_sum / weights.y;
    excess.xyz = excess_sum / (others + DENOISE_LEAST_LIKE);
  }
  set_plane(params.filtered, i, first);
  set_plane(params.filtered + 1u, i, second);
  set_plane(params.filtered + 2u, i, excess);
}

void join(uint i) {
  vec3 excess = plane(params.light + 2u, i).xyz;
  set_plane(DENOISE_PLANE_GUIDE, i,
            joined(i, plane(params.light, i).xyz + excess, plane(params.light + 1u, i).xyz + excess));
}

void limit_rims(uint i) {
  vec4 own = plane(DENOISE_PLANE_GUIDE, i);
  vec3 most = plane(DENOISE_PLANE_PART, i).xyz;
  bool alone = true;
  if (is_rim(i) && is_surface(i))
    for (int dy = -2; dy <= 2; ++dy)
      for (int dx = -2; dx <= 2; ++dx) {
        ivec2 beside = place_of(i) + ivec2(dx, dy);
        if (!is_inside(beside) || is_rim(at(beside))) continue;
        alone = false;
        most = max(most, plane(DENOISE_PLANE_GUIDE, at(beside)).xyz);
      }
  result[i] = alone ? own : vec4(min(own.xyz, most), own.w);
}

void main() {
  uint i = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * GROUP_SIZE + gl_LocalInvocationIndex;
  if (i >= (STEP == DENOISE_PIECES ? pieces_of_row() * params.height : pixels())) return;
  if (STEP == DENOISE_FINITE) make_finite(i);
  if (STEP == DENOISE_PIECES) find_piece(i);
  if (STEP == DENOISE_TAKE) take_apart(i);
  if (STEP == DENOISE_VARIANCE) find_variance(i);
  if (STEP == DENOISE_GUIDE) find_guide(i);
  if (STEP == DENOISE_PASS) filter_pass(i);
  if (STEP == DENOISE_JOIN) join(i);
  if (STEP == DENOISE_RIMS) limit_rims(i);
  if (STEP == DENOISE_KEEP) part[i] = mean_at(i);
}
