// One light path through a pixel: trace, shade, follow the mirror or glass, until it ends. At glass one of
// the two branches is followed, chosen by Fresnel's share with a stratified random number, so both are
// accounted for over a pixel's samples. Needs shade.glsl, random.glsl, camera.glsl and the constants MIRRORS,
// GLASS.
#ifndef SPLATRAY_PATH_GLSL
#define SPLATRAY_PATH_GLSL
#include "camera.glsl"
#include "random.glsl"
#include "shade.glsl"

const float THROUGHPUT_LEAST = 0.001953125f;  ///< 2^-9: a path that carries less ends

/// What a path found, and the rays it took.
struct PathResult {
  vec3 radiance;
  float coverage;      ///< 1 when the primary ray hit something
  uint reflected;
  uint refracted;
  uint shadow;
  uint leaked;         ///< 1 when it left the scene while inside a dielectric
  uint cut;            ///< 1 when the bounce limit ended it
  float energy_lost;   ///< its throughput then
};

/// The ray that goes on from a hit on a dielectric: reflected when `choice` is below Fresnel's share, else
/// refracted.
Ray dielectric_ray(Hit hit, Ray ray, Material material, float choice, OUT(bool) reflected) {
  uint object_bit = 1u << material.mask_bit;
  uint others = ray.inside & ~object_bit;
  // Light runs in the dielectric with the highest bit of the mask.
  float ior_without = others != 0u ? medium_at(uint(findMSB(others))) : 1.0f;
  float ior_with = others > object_bit ? ior_without : material.ior;
  float eta = hit.front ? ior_without / ior_with : ior_with / ior_without;
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

/// Light sent back from the surface itself, without what it mirrors or refracts.
vec3 local_light(Hit hit, Ray ray, Material material, INOUT(uint) shadow_rays, INOUT(Tally) tally) {
  bool dielectric = (material.flags & MATERIAL_DIELECTRIC) != 0u;
  vec3 diffuse = material.diffuse * hit.color;
  if (GLASS == 1u) diffuse = dielectric ? vec3(0.0f) : diffuse;
  vec3 light = diffuse * environment_diffuse(hit.normal);
  if (LIGHTS == 1u) light += shade_lights(hit, ray.dir, diffuse, material, ray.inside, shadow_rays, tally);
  return light;
}

/// Follows one path. `pixel` numbers the pixel in the whole picture.
PathResult trace_path(Ray ray, uint pixel, uint sample_index, INOUT(Tally) tally) {
  PathResult result;
  result.radiance = vec3(0.0f);
  result.coverage = 0.0f;
  result.reflected = 0u;
  result.refracted = 0u;
  result.shadow = 0u;
  result.leaked = 0u;
  result.cut = 0u;
  result.energy_lost = 0.0f;
  vec3 throughput = vec3(1.0f);
  uint bounce = 0u;
  bool alive = true;
  do {
    Hit hit = trace_nearest(ray, frame.kappa, tally);
    if (hit.found) {
      Material material = material_at(hit.object);
      bool dielectric = GLASS == 1u && (material.flags & MATERIAL_DIELECTRIC) != 0u;
      float mirror = MIRRORS == 1u && !dielectric ? material.mirror : 0.0f;
      result.coverage = bounce == 0u ? 1.0f : result.coverage;
      vec3 local = local_light(hit, ray, material, result.shadow, tally);
      result.radiance += throughput * local * (1.0f - mirror);
      alive = dielectric || mirror > 0.0f;
      if (MIRRORS == 1u || GLASS == 1u) {
        bool reflected = true;
        Ray next = ray_from_hit(hit, reflect(ray.dir, hit.normal), ray.inside);
        if (GLASS == 1u && dielectric) {
          next = dielectric_ray(hit, ray, material, path_random(pixel, sample_index, bounce, frame.seed), reflected);
        }
        throughput *= dielectric ? (reflected ? vec3(1.0f) : material.tint) : material.tint * mirror;
        bool bright = max(throughput.x, max(throughput.y, throughput.z)) >= THROUGHPUT_LEAST;
        bool cut = alive && (bounce >= frame.max_bounces || !bright);
        result.cut = cut ? 1u : result.cut;
        result.energy_lost = cut ? (throughput.x + throughput.y + throughput.z) / 3.0f : result.energy_lost;
        alive = alive && !cut;
        result.reflected += alive && reflected ? 1u : 0u;
        result.refracted += alive && !reflected ? 1u : 0u;
        ray = next;
        bounce += 1u;
      }
    } else {
      result.radiance += throughput * environment_radiance(ray.dir);
      result.leaked = ray.inside != 0u ? 1u : 0u;
      alive = false;
    }
  } while (alive);
  return result;
}

#endif
