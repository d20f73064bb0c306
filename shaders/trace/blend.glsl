// What a ray sees first, blended, by the tree that is there: the octree, or the host's.
#ifndef SPLATRAY_BLEND_GLSL
#define SPLATRAY_BLEND_GLSL
#include "trace/octree.glsl"

/// What the ray sees first, and whether a splat is a member of it. HOST: engine/cpu/wide_trace.h, by the wide tree.
#ifdef HOST
Hit trace_watching(const Ray& ray, float kappa, uvec4 target, INOUT(Tally) tally);
#else
Hit trace_watching(Ray ray, float kappa, uvec4 target, INOUT(Tally) tally) {
  return trace_octree(ray, kappa, target, tally);
}
#endif

/// What the ray sees first.
Hit trace_nearest(Ray ray, float kappa, INOUT(Tally) tally) {
  return trace_watching(ray, kappa, NO_SPLAT, tally);
}

#endif
