// What tracing a ray gives, and the work it took.
#ifndef SPLATRAY_HIT_GLSL
#define SPLATRAY_HIT_GLSL
#include "lang/language.glsl"
#ifdef LIT
#include "trace/factors.glsl"
#endif

/// What a ray hits. Distances are from the ray's own origin, in units of |dir|.
struct Hit {
  bool found;
  float t;          ///< blended
  vec3 position;    ///< blended, root space
  vec3 normal;      ///< blended unit normal, turned against the ray
  vec3 color;       ///< blended linear colour; 1 without colours
  bool front;       ///< the first splat's front face was hit
  uint object;
  uint members;
  float t_first;
#ifdef LIT
  Factors factors;  ///< blended
  vec3 plane;       ///< blended unit normal without normal maps, which `normal` has
#endif
  uvec4 first;      ///< words of the first splat (BLEND_PAPER, BLEND_LEAF: the reference splat)
  float target_fraction;  ///< of its members that are the target splat, 0..1
};

/// Work done by this invocation; kept only with COUNTERS.
struct Tally {
  uint leaves;
  uint node_steps;
  uint tests;
  uint lost;
};

// No constructors of structs: as C++ they want Clang 16.
Tally no_tally() {
  Tally tally;
  tally.leaves = 0u;
  tally.node_steps = 0u;
  tally.tests = 0u;
  tally.lost = 0u;
  return tally;
}

#endif
