// How much light passes along a ray. Needs what accept.glsl needs, and the constant TINTED: dielectrics
// tint light, else they are as opaque as anything.
#ifndef SPLATRAY_SHADOW_GLSL
#define SPLATRAY_SHADOW_GLSL
#include "trace/accept.glsl"

/// How much light passes along the ray: 0 behind anything opaque, the product of the tints of the dielectrics
/// met, as if they did not bend it (each object counts once), else 1. The ray starts inside the root; one that ends before it
/// starts is not traced.
vec3 trace_shadow(Ray ray, INOUT(Tally) tally) {
  First first = no_first();
  Walk walk = walk_start(ray, 0.0f, ray.t_max >= 0.0f);
  vec3 light = vec3(1.0f);
  uint passed = 0u;
  do {
    uint chunk = 0u;
    uint candidates = walk_candidates(walk, ray, ray.t_max, false, chunk, tally);
    uint accepted = accept_candidates(chunk, candidates, ray, walk, false, first);
    bool opaque = accepted != 0u;
    if (TINTED) {
      opaque = false;
      do {
        if (accepted != 0u) {
          uint bit = uint(findLSB(accepted));
          accepted &= accepted - 1u;
          Material material = material_at(splat_object(splat_words(splat_at(chunk + bit))));
          bool glass = (material.flags & MATERIAL_DIELECTRIC) != 0u;
          uint object_bit = 1u << material.mask_bit;
          light = glass && (passed & object_bit) == 0u ? light * (material.tint * material.tint) : light;
          passed |= glass ? object_bit : 0u;
          opaque = opaque || !glass;
        }
      } while (accepted != 0u);
    }
    light = opaque ? vec3(0.0f) : light;
    walk.inside = walk.inside && !opaque;
  } while (walk.inside);
  return light;
}

#endif
