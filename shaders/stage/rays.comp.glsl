#version 450
#extension GL_GOOGLE_include_directive : require
// Ray queries: one thread per RayQuery, frame.tile_width of them; the exact hit of that very ray.
#include "scene/bindings.glsl"

layout(std430, binding = BIND_RAYS) readonly buffer RayTable { RayQuery rays[]; };
layout(std430, binding = BIND_HITS) writeonly buffer HitTable { RayHit hits[]; };

#include "stage/query.glsl"

void main() {
  read_frame();
  uint index = gl_GlobalInvocationID.x;
  if (index >= frame.tile_width) return;
  Tally tally = Tally(0u, 0u, 0u, 0u);
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
