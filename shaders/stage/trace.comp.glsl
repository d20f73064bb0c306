#version 450
#extension GL_GOOGLE_include_directive : require
// A tile of an image: paths; with OUTPUT_AOV what the ray through each pixel's centre hits.
#include "scene/bindings.glsl"
#include "stage/trace.glsl"

void main() {
  uvec2 in_tile = uvec2(0u);
  if (find_pixel(in_tile)) trace_pixel(in_tile);
}
