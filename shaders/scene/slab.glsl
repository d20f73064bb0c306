// A leaf's slab and halves (layout.h): rays that pass beside the slab need none of the leaf's splats, others often but a half.
#ifndef SPLATRAY_SLAB_GLSL
#define SPLATRAY_SLAB_GLSL
#include "primitive/disc.glsl"

/// By how much slabs are wider than stored, lattice units: hits that count for a leaf lie up to LIST_INFLATION outside its
/// cell, to which slabs are cut; the rest, 4, is for float32. |origin| <= 2^22 and |dir t| < 2^23 on each axis, so a point
/// from the centre is off by 2^-3 for the origin's low part left out, 2^-3 for origin - center, 2^-2 for dir t and 2^-3 for
/// the sum, less than 1; along the axis by no more, as |x| + |y| + |z| = 1. That point is at most 2^22 away: axis, products
/// and their sums add 5 * 2^-24 of it, less than 2. The planes, at most 3 * 2^20 away, are off by 5 * 2^-24 of that, less than 1.
const float SLAB_WIDENING = float(LIST_INFLATION) + 4.0f;

/// Earlier than any t in the root for a ray whose origin is in it or beside it.
const float EARLIEST = -2.0f * float(1u << LATTICE_BITS);

/// Axis, |x| + |y| + |z| = 1, x >= 0.
vec3 slab_axis(uint word) {
  float x = float(word & 31u);
  float y = float((word >> 5u) & 63u) - float(SLAB_AXIS_SCALE);
  float z = float(SLAB_AXIS_SCALE) - x - abs(y);
  float fold = max(-z, 0.0f);
  return vec3(x - fold, y >= 0.0f ? y - fold : y + fold, z) * (1.0f / float(SLAB_AXIS_SCALE));
}

/// A ray's interval [t_in, t_out) in a leaf's cell, against the leaf's slab.
struct SlabCrossing {
  vec3 axis;
  vec3 point_in;   ///< where the interval begins and ends, from the cell's centre
  vec3 point_out;
  float at_in;     ///< these along the axis
  float at_out;
  float low;       ///< the slab's planes, as wide apart as they must be
  float high;
};

SlabCrossing slab_crossing(uint word, Ray ray, float t_in, float t_out, vec3 center, float half_size) {
  SlabCrossing crossing;
  crossing.axis = slab_axis(word);
  float thickness = uintBitsToFloat((508u << 21u) + (((word >> 19u) & 31u) << 21u));
  crossing.low = (float((word >> 11u) & 255u) - float(SLAB_SCALE)) * (half_size * (1.0f / float(SLAB_SCALE))) - SLAB_WIDENING;
  crossing.high = crossing.low + thickness * (half_size * (1.0f / float(SLAB_THINNEST))) + 2.0f * SLAB_WIDENING;
  vec3 from_center = ray.origin - center;
  crossing.point_in = from_center + ray.dir * max(t_in, EARLIEST);
  crossing.point_out = from_center + ray.dir * t_out;
  crossing.at_in = dot(crossing.axis, crossing.point_in);
  crossing.at_out = dot(crossing.axis, crossing.point_out);
  return crossing;
}

/// Whether the interval surely lies on one side of the slab.
bool slab_missed(SlabCrossing crossing) {
  return max(crossing.at_in, crossing.at_out) < crossing.low || min(crossing.at_in, crossing.at_out) > crossing.high;
}

/// The part [begin, end) of the list of a leaf whose slab is not missed that holds all the interval may meet: the halves which
/// it reaches between the slab's planes. What float32 adds to the points and the share of the interval, less than 2, is within
/// SLAB_WIDENING.
void slab_halves(uint word, SlabCrossing crossing, INOUT(uint) begin, INOUT(uint) end) {
  float across = crossing.at_out - crossing.at_in;
  bool along = abs(across) < 1.0f;
  float inverse = 1.0f / across;
  float enter = ((across > 0.0f ? crossing.low : crossing.high) - crossing.at_in) * inverse;
  float leave = ((across > 0.0f ? crossing.high : crossing.low) - crossing.at_in) * inverse;
  vec3 size = abs(crossing.axis);
  bool is_x = size.x <= size.y && size.x <= size.z;
  bool is_y = size.y <= size.z;
  float in_u = is_x ? crossing.point_in.x : (is_y ? crossing.point_in.y : crossing.point_in.z);
  float out_u = is_x ? crossing.point_out.x : (is_y ? crossing.point_out.y : crossing.point_out.z);
  float enter_u = in_u + (out_u - in_u) * (along ? 0.0f : clamp(enter, 0.0f, 1.0f));
  float leave_u = in_u + (out_u - in_u) * (along ? 1.0f : clamp(leave, 0.0f, 1.0f));
  bool lower = min(enter_u, leave_u) < SLAB_WIDENING;
  bool upper = max(enter_u, leave_u) > -SLAB_WIDENING;
  uint listed = end - begin;
  uint share = (listed + (SLAB_SHARES - 1u)) / SLAB_SHARES;
  uint lower_end = min(share * (((word >> 24u) & 15u) + 1u), listed);
  uint upper_begin = min(share * (word >> 28u), listed);
  end = upper ? end : begin + lower_end;
  begin = lower ? begin : begin + upper_begin;
}

#endif
