// A thread of rays.comp.glsl. Needs what bindings.glsl declares.
#ifndef SPLATRAY_RAYS_GLSL
#define SPLATRAY_RAYS_GLSL
#include "stage/query.glsl"

/// Answers a ray query.
void answer_ray(uint index) {
  Tally tally = no_tally();
  RayHit hit = answer_query(rays[index], frame.kappa, frame.delta, tally);
  hits[index] = hit;
  if (COUNTERS) {
    count(COUNT_PRIMARY, 1u);
    count(COUNT_LEAVES, tally.leaves);
    count(COUNT_NODE_STEPS, tally.node_steps);
    count(COUNT_TESTS, tally.tests);
    count(COUNT_HITS, hit.object != NO_OBJECT ? 1u : 0u);
    count(COUNT_LOST, tally.lost);
  }
}

#endif
