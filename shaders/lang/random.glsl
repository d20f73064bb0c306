// Seeded numbers. Everything is a function of (pixel, sample, dimension, seed), so a picture does not depend
// on threads or tiles.
#ifndef SPLATRAY_RANDOM_GLSL
#define SPLATRAY_RANDOM_GLSL
#include "lang/language.glsl"

/// Hash of 32 bits (C. Wellons 2018, "Prospecting for Hash Functions", the low-bias 32-bit mixer).
uint hash_uint(uint x) {
  x ^= x >> 16u;
  x *= 0x7feb352du;
  x ^= x >> 15u;
  x *= 0x846ca68bu;
  x ^= x >> 16u;
  return x;
}

/// A number that distinguishes splats.
uint hash_words(uvec4 words) {
  return hash_uint(words.x ^ hash_uint(words.y ^ hash_uint(words.z ^ hash_uint(words.w))));
}

/// [0, 1) from the upper 24 bits.
float unit_float(uint x) { return float(x >> 8u) * 5.9604645e-8f; }

/// Where sample `index` goes within a pixel, each coordinate in [0, 1): the R2 sequence (M. Roberts 2018,
/// "The Unreasonable Effectiveness of Quasirandom Sequences") in 32-bit fixed point; sample 0 is the pixel's
/// centre.
vec2 pixel_sample(uint index) {
  return vec2(unit_float(0x80000000u + index * 3242174889u), unit_float(0x80000000u + index * 2447445414u));
}

/// The number of dimension `dimension` of a path, [0, 1): stratified over a pixel's samples by the golden
/// ratio, with an offset of its own for each pixel, dimension and seed.
float path_random(uint pixel, uint sample_index, uint dimension, uint seed) {
  uint offset = hash_uint(pixel ^ hash_uint(dimension + 0x9e3779b9u * seed));
  return unit_float(offset + sample_index * 2654435769u);
}

#endif
