#version 450
#extension GL_GOOGLE_include_directive : require
// Whether fma() rounds once (FEATURE_FUSED): counts as COUNT_LOST the rows (a, b, a * b rounded, what that leaves out) of which it
// finds another remainder. A program of its own, as drivers take long to read the others.
#include "scene/bindings.glsl"
#include "lang/double_float.glsl"

void main() {
  uint row = gl_GlobalInvocationID.x;
  if (row >= FUSED_ROWS) return;
  vec4 product = region_plane(row);
  if (fused_low(product.x, product.y, product.z) != product.w) count(COUNT_LOST, 1u);
}
