// Numbers that fill the unit square evenly, for each of a path's decisions: two pairs of the two-dimensional Sobol sequence,
// shuffled and Owen-scrambled by hashes (Burley 2020, "Practical Hash-based Owen Scrambling"). Integers only, so the same on
// every device.
#ifndef SPLATRAY_SOBOL_GLSL
#define SPLATRAY_SOBOL_GLSL
#include "lang/random.glsl"

/// Bits in reverse order; the steps of 16 and 8 last.
uint reversed(uint x) {
  x = ((x >> 1u) & 0x55555555u) | ((x & 0x55555555u) << 1u);
  x = ((x >> 2u) & 0x33333333u) | ((x & 0x33333333u) << 2u);
  x = ((x >> 4u) & 0x0F0F0F0Fu) | ((x & 0x0F0F0F0Fu) << 4u);
  x = ((x >> 8u) & 0x00FF00FFu) | ((x & 0x00FF00FFu) << 8u);
  return (x >> 16u) | (x << 16u);
}

/// Owen's scrambling of bits in reverse order: each depends on those below it (Laine and Karras 2011, "Stratified Sampling for
/// Stochastic Transparency"; constants by N. Vegdahl 2021, "Building a Better LK Hash").
uint owen_scrambled(uint x, uint seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16u) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

/// The second dimension of the Sobol sequence, index and value in reverse order: Pascal's triangle modulo 2.
uint sobol_second(uint index) {
  index ^= index >> 16u;
  index ^= (index >> 8u) & 0x00FF00FFu;
  index ^= (index >> 4u) & 0x0F0F0F0Fu;
  index ^= (index >> 2u) & 0x33333333u;
  return index ^ ((index >> 1u) & 0x55555555u);
}

/// A pair of numbers in [0, 1) of a sample. `index_reversed`: the sample's, bits in reverse order.
vec2 sobol_pair(uint index_reversed, uint seed) {
  uint index = reversed(owen_scrambled(index_reversed, seed));
  uint x = owen_scrambled(index, hash_uint(seed + 1u));
  uint y = owen_scrambled(sobol_second(index), hash_uint(seed + 2u));
  return vec2(unit_float(reversed(x)), unit_float(reversed(y)));
}

/// Two pairs of numbers in [0, 1) for a decision of a pixel's sample: over the samples each pair is a (0, 2)-sequence of its own.
vec4 sobol_sample(uint pixel, uint sample_index, uint group, uint seed) {
  uint own = hash_uint(pixel ^ hash_uint(group + 0x9e3779b9u * seed));
  uint index = reversed(sample_index);
  vec2 first = sobol_pair(index, own);
  vec2 second = sobol_pair(index, hash_uint(own));
  return vec4(first.x, first.y, second.x, second.y);
}

#endif
