// A thread of trace.comp.glsl. Needs what bindings.glsl declares.
#ifndef SPLATRAY_TRACE_GLSL
#define SPLATRAY_TRACE_GLSL
#include "stage/paths.glsl"

#ifndef LIT
void write_aov(uvec2 pixel, uint index) {
  Tally tally = no_tally();
  float eye_distance = 0.0f;
  Ray ray = center_ray(pixel, eye_distance);
  Hit hit = trace_nearest(ray, frame.kappa, tally);
  aov[index].normal = hit.found ? hit.normal : vec3(0.0f);
  // A blended hit may lie a little before the first disc's, and so before the eye.
  aov[index].z = hit.found ? max(hit.t + eye_distance, 0.0f) * frame.root_unit_world : INFINITY_F;
  aov[index].object = hit.object;
  aov[index].splat = (hash_words(hit.first) & ~1u) | (hit.front ? 1u : 0u);
  aov[index].tests = tally.tests;
  aov[index].steps = tally.node_steps;
}
#endif

/// Traces a pixel of the tile.
void trace_pixel(uvec2 in_tile) {
  uvec2 pixel = in_tile + uvec2(frame.tile_x, frame.tile_y);
  uint index = frame.tile_first + in_tile.y * frame.tile_width + in_tile.x;
#ifndef LIT
  if (OUTPUT == OUTPUT_AOV) {
    write_aov(pixel, index);
  } else
#endif
  {
    add_samples(pixel, index);
  }
}

#endif
