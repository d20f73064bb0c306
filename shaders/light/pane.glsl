// Panes: dielectrics of index 1, which bend no light, so that light of lights arrives through them straight. Needs what bsdf.glsl
// and cluster.glsl need.
#ifndef SPLATRAY_PANE_GLSL
#define SPLATRAY_PANE_GLSL
#include "light/bsdf.glsl"
#include "trace/cluster.glsl"

/// What a splat of a pane that is not see-through lets through, 0..1: what paths that pass it (scatter) carry on of their light, on
/// the mean. Its material is the object's.
vec3 pane_passes(uint splat, uvec4 words, Material material, PlaneHit hit, Ray ray) {
  vec3 color = vec3(1.0f);
  if (COLORS) color = color_at(splat);
  Bsdf bsdf = bsdf_of(textured(material, factors_at(splat)), color, 1.0f);
  bsdf_seen(bsdf, max(-dot(normal_against(words, ray.dir), ray.dir), 1e-6f));
  return (hit.facing < 0.0f ? bsdf.tint : vec3(1.0f)) * (bsdf.below * bsdf.glass_chosen);
}

#endif
