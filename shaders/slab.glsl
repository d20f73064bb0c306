// A leaf's slab (layout.h): rays that pass beside it need none of the leaf's splats.
#ifndef SPLATRAY_SLAB_GLSL
#define SPLATRAY_SLAB_GLSL
#include "splat.glsl"

/// By how much slabs are wider than stored, lattice units: hits that count for a leaf lie up to LIST_INFLATION outside its
/// cell, to which slabs are cut; the rest, 4, is for float32. |origin| <= 2^22 and |dir t| < 2^23 on each axis, so a point
/// from the centre is off by 2^-3 for the origin's low part left out, 2^-3 for origin - center, 2^-2 for dir t and 2^-3 for
/// the sum, less than 1; along the axis by no more, as |x| + |y| + |z| = 1. That point is at most 2^22 away: axis, products
/// and their sums add 5 * 2^-24 of it, less than 2. The planes, at most 2^20 away, are off by 4 * 2^-24 of that, 1/4.
const float SLAB_WIDENING = float(LIST_INFLATION) + 4.0f;

/// Earlier than any t in the root for a ray whose origin is in it or beside it.
const float EARLIEST = -2.0f * float(1u << LATTICE_BITS);

/// Axis, |x| + |y| + |z| = 1.
vec3 slab_axis(uint word) {
  float x = float(word & 63u) - float(SLAB_AXIS_SCALE);
  float y = float((word >> 6u) & 63u) - float(SLAB_AXIS_SCALE);
  float z = float(SLAB_AXIS_SCALE) - abs(x) - abs(y);
  float fold = max(-z, 0.0f);
  return vec3(x >= 0.0f ? x - fold : x + fold, y >= 0.0f ? y - fold : y + fold, z) * (1.0f / float(SLAB_AXIS_SCALE));
}

/// Whether a ray's interval [t_in, t_out) in a cell surely lies on one side of the cell's slab.
bool slab_missed(uint word, Ray ray, float t_in, float t_out, vec3 center, float half_size) {
  vec3 axis = slab_axis(word);
  float unit = half_size * (1.0f / float(SLAB_SCALE));
  float low = (float((word >> 12u) & 1023u) - 512.0f) * unit - SLAB_WIDENING;
  float high = (float(word >> 22u) - 512.0f) * unit + SLAB_WIDENING;
  vec3 from_center = ray.origin - center;
  float at_in = dot(axis, from_center + ray.dir * max(t_in, EARLIEST));
  float at_out = dot(axis, from_center + ray.dir * t_out);
  return max(at_in, at_out) < low || min(at_in, at_out) > high;
}

#endif
