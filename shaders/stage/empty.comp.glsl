#version 450
#extension GL_GOOGLE_include_directive : require
// Pixels that no leaf projects to (engine/image/footprint.h): all their rays meet the environment. A program of its own, as drivers
// take as long to read one with the walk in it whether the walk is used or not. In STAGE_FUSED, instead, whether fma() rounds once.
#include "scene/bindings.glsl"
#include "lang/double_float.glsl"
#include "stage/empty.glsl"

/// Counts as COUNT_LOST the rows (a, b, a * b rounded, what that leaves out) of which fma() finds another remainder.
void try_products() {
  uint row = gl_GlobalInvocationID.x;
  if (row < FUSED_ROWS) {
    vec4 product = region_plane(row);
    if (fused_low(product.x, product.y, product.z) != product.w) count(COUNT_LOST, 1u);
  }
}

void main() {
  read_frame();
  if (STAGE == STAGE_FUSED) {
    try_products();
    return;
  }
  uvec2 in_tile = uvec2(0u);
  if (!find_pixel(in_tile)) return;
  miss_all(in_tile);
}
