// Double-float arithmetic: a number is the unevaluated sum of two float32, vec2(high, low), about 48 bits. T.
// J. Dekker 1971, "A floating-point technique for extending the available precision"; D. E. Knuth, TAOCP 2,
// 4.2.2. Needs nothing but correctly rounded + - *; the quotient is corrected from its residue, so an inexact
// division will do. PRECISE forbids the compiler to reorder or fuse. On GPUs needs the constant FUSED.
#ifndef SPLATRAY_DOUBLE_FLOAT_GLSL
#define SPLATRAY_DOUBLE_FLOAT_GLSL
#include "lang/language.glsl"

/// a + b exactly.
vec2 two_sum(float a, float b) {
  PRECISE float s = a + b;
  PRECISE float b_seen = s - a;
  PRECISE float a_seen = s - b_seen;
  PRECISE float b_lost = b - b_seen;
  PRECISE float a_lost = a - a_seen;
  PRECISE float low = a_lost + b_lost;
  return vec2(s, low);
}

/// a + b exactly when |a| >= |b| or a == 0.
vec2 quick_two_sum(float a, float b) {
  PRECISE float s = a + b;
  PRECISE float b_seen = s - a;
  PRECISE float low = b - b_seen;
  return vec2(s, low);
}

/// a in two halves of 12 bits each (Veltkamp); |a| < 2^114.
vec2 split_float(float a) {
  PRECISE float c = 4097.0f * a;
  PRECISE float big = c - a;
  PRECISE float high = c - big;
  PRECISE float low = a - high;
  return vec2(high, low);
}

/// a * b exactly, given both halves of each (barring underflow).
vec2 two_product_split(float a, vec2 a_halves, float b, vec2 b_halves) {
  PRECISE float p = a * b;
  PRECISE float e0 = a_halves.x * b_halves.x - p;
  PRECISE float e1 = e0 + a_halves.x * b_halves.y;
  PRECISE float e2 = e1 + a_halves.y * b_halves.x;
  PRECISE float low = e2 + a_halves.y * b_halves.y;
  return vec2(p, low);
}

#ifndef __cplusplus
/// What a product a * b, rounded to p, leaves out. That is a float32 itself (barring underflow; Muller et al. 2018, "Handbook of
/// Floating-Point Arithmetic", sec. 4.4), so an fma that rounds once finds it exactly, as the halves do: the same bits.
float fused_low(float a, float b, float p) {
  PRECISE float low = fma(a, b, -p);
  return low;
}
#endif

#ifdef __cplusplus
/// a * b exactly (barring underflow).
vec2 two_product(float a, float b) { return two_product_split(a, split_float(a), b, split_float(b)); }

/// a * a exactly.
vec2 square_exactly(float a) {
  vec2 halves = split_float(a);
  return two_product_split(a, halves, a, halves);
}
#else
/// a * b exactly (barring underflow).
vec2 two_product(float a, float b) {
  PRECISE float p = a * b;
  vec2 product = vec2(p, 0.0f);
  if (FUSED) {
    product.y = fused_low(a, b, p);
  } else {
    product = two_product_split(a, split_float(a), b, split_float(b));
  }
  return product;
}

/// a * a exactly.
vec2 square_exactly(float a) { return two_product(a, a); }
#endif

vec2 df_add(vec2 a, vec2 b) {
  vec2 s = two_sum(a.x, b.x);
  PRECISE float low = a.y + b.y;
  PRECISE float low_all = s.y + low;
  return quick_two_sum(s.x, low_all);
}

/// a * b for a float b.
vec2 df_scale(vec2 a, float b) {
  vec2 p = two_product(a.x, b);
  PRECISE float low = a.y * b;
  PRECISE float low_all = p.y + low;
  return quick_two_sum(p.x, low_all);
}

vec2 df_square(vec2 a) {
  vec2 p = square_exactly(a.x);
  PRECISE float cross_term = 2.0f * a.x;
  PRECISE float low = cross_term * a.y;
  PRECISE float low_all = p.y + low;
  return quick_two_sum(p.x, low_all);
}

vec2 df_divide(vec2 a, vec2 b) {
  PRECISE float q0 = a.x / b.x;
  vec2 residue = df_add(a, df_scale(b, -q0));
  PRECISE float q1 = residue.x / b.x;
  residue = df_add(residue, df_scale(b, -q1));
  PRECISE float q2 = residue.x / b.x;
  vec2 q = quick_two_sum(q0, q1);
  PRECISE float low = q.y + q2;
  return quick_two_sum(q.x, low);
}

/// a < b; false when either is NaN.
bool df_less(vec2 a, vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); }

#endif
