// Where light goes on from a hit: mirrored or through glass. Needs `frame`, medium_at(bit), the constant SIDE, and what
// region.glsl needs.
#ifndef SPLATRAY_MATERIAL_GLSL
#define SPLATRAY_MATERIAL_GLSL
#include "light/microfacet.glsl"
#include "trace/hit.glsl"
#include "trace/region.glsl"

/// A ray that leaves a surface. It ignores the sheet it leaves (splat_of_sheet_left) or, with SIDE_DELTA, everything nearer than
/// delta (Linsen et al. 2007).
Ray secondary_ray(vec3 origin, vec3 dir, uint inside, vec3 from_normal, uint from_object) {
  Ray ray;
  ray.origin = origin;
  ray.origin_low = vec3(0.0f);
  ray.dir = dir;
  ray.t_min = SIDE == SIDE_DELTA ? frame.delta : 0.0f;
  ray.t_max = INFINITY_F;
  ray.inside = inside;
  ray.from_normal = from_normal;
  ray.from_object = from_object;
  ray = unbounded(ray);
  if (REGION) ray.bounded = region_light();
  return ray;
}

Ray ray_from_hit(Hit hit, vec3 dir, uint inside) {
#ifdef LIT
  vec3 normal = hit.plane;
#else
  vec3 normal = hit.normal;
#endif
  return secondary_ray(hit.position, dir, inside, hit.front ? normal : -normal, hit.object);
}

/// Index of refraction before a hit on a dielectric over that behind it.
float eta_at(Hit hit, uint inside, Material material) {
  uint object_bit = 1u << material.mask_bit;
  uint others = inside & ~object_bit;
  // Light runs in the dielectric with the highest bit of the mask.
  float ior_without = others != 0u ? medium_at(uint(findMSB(others))) : 1.0f;
  float ior_with = others > object_bit ? ior_without : material.ior;
  return hit.front ? ior_without / ior_with : ior_with / ior_without;
}

/// The ray that goes on from a hit on a dielectric: reflected when `choice` is below Fresnel's share, else
/// refracted.
Ray dielectric_ray(Hit hit, Ray ray, Material material, float choice, OUT(bool) reflected) {
  uint object_bit = 1u << material.mask_bit;
  float eta = eta_at(hit, ray.inside, material);
  float cosine = clamp(-dot(ray.dir, hit.normal), 0.0f, 1.0f);
  float cosine_behind = 0.0f;
  float share = fresnel(eta, cosine, cosine_behind);
  reflected = choice < share;
  vec3 mirrored = ray.dir + hit.normal * (2.0f * cosine);
  vec3 refracted = ray.dir * eta + hit.normal * (eta * cosine - cosine_behind);
  vec3 dir = reflected ? mirrored : refracted;
  uint inside = reflected ? ray.inside : ray.inside ^ object_bit;
  return ray_from_hit(hit, dir * inversesqrt(dot(dir, dir)), inside);
}

#endif
