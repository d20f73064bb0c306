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

/// Traces what find_work has found.
void trace_work(INOUT(Work) work) {
#ifndef LIT
  if (STAGE == STAGE_AOV) {
    write_aov(work.pixel, work.place - frame.tile_first);
  } else
#endif
  {
    add_samples(work);
  }
}

#endif
