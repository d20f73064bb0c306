#version 450
#extension GL_GOOGLE_include_directive : require
// Ray queries: one thread per RayQuery, frame.tile_width of them; the exact hit of that very ray.
#include "scene/bindings.glsl"
#include "stage/rays.glsl"

void main() {
  uint index = gl_GlobalInvocationID.x;
  if (index >= frame.tile_width) return;
  answer_ray(index);
}
