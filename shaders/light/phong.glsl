// One light path through a pixel: trace, shade, follow the mirror or glass, until it ends. At glass one of
// the two branches is followed, chosen by Fresnel's share with a stratified random number, so both are
// accounted for over a pixel's samples. Needs the constants MIRRORS, GLASS, LIGHTS.
#ifndef SPLATRAY_PHONG_GLSL
#define SPLATRAY_PHONG_GLSL
#include "lang/random.glsl"
#include "light/environment.glsl"
#include "light/lights.glsl"
#include "light/path.glsl"
#include "trace/blend.glsl"

const float THROUGHPUT_LEAST = 0.001953125f;  ///< 2^-9: a path that carries less ends

/// Light sent back from the surface itself, without what it mirrors or refracts. `counts`: a full mirror has no use for it.
vec3 local_light(Hit hit, Ray ray, Material material, bool counts, INOUT(uint) shadow_rays, INOUT(Tally) tally) {
  bool dielectric = (material.flags & MATERIAL_DIELECTRIC) != 0u;
  vec3 diffuse = material.phong.diffuse * hit.color;
  if (GLASS) diffuse = dielectric ? vec3(0.0f) : diffuse;
  vec3 light = diffuse * environment_diffuse(hit.normal);
  if (LIGHTS) {
    bool scatters = counts && max(max(diffuse.x, diffuse.y), max(diffuse.z, material.phong.specular)) > 0.0f;
    light += shade_lights(hit, ray.dir, diffuse, material.phong, ray.inside, scatters, shadow_rays, tally);
  }
  return light;
}

/// Follows a path: to its end or, in a stage, for one ray. `pixel` numbers the pixel in the whole picture.
void follow_path(INOUT(Path) path, uint pixel, uint sample_index, INOUT(Tally) tally) {
  do {
    Hit hit = trace_nearest(path.ray, frame.kappa, tally);
    if (hit.found) {
      Material material = material_at(hit.object);
      bool dielectric = GLASS && (material.flags & MATERIAL_DIELECTRIC) != 0u;
      float mirror = MIRRORS && !dielectric ? material.phong.mirror : 0.0f;
      path.coverage = path.bounce == 0u ? 1.0f : path.coverage;
      vec3 local = local_light(hit, path.ray, material, mirror < 1.0f, path.shadow, tally);
      path.radiance += path.throughput * local * (1.0f - mirror);
      path.alive = dielectric || mirror > 0.0f;
      if (MIRRORS || GLASS) {
        bool reflected = true;
        Ray next = ray_from_hit(hit, reflect(path.ray.dir, hit.normal), path.ray.inside);
        if (GLASS && dielectric) {
          float choice = path_random(pixel, sample_index, path.bounce, frame.seed);
          next = dielectric_ray(hit, path.ray, material, choice, reflected);
        }
        path.throughput *= dielectric ? (reflected ? vec3(1.0f) : material.phong.tint) : material.phong.tint * mirror;
        bool bright = max(path.throughput.x, max(path.throughput.y, path.throughput.z)) >= THROUGHPUT_LEAST;
        bool cut = path.alive && (path.bounce >= frame.max_bounces || !bright);
        path.cut = cut ? 1u : path.cut;
        path.energy_lost = cut ? (path.throughput.x + path.throughput.y + path.throughput.z) / 3.0f : path.energy_lost;
        path.alive = path.alive && !cut;
        path.reflected += path.alive && reflected ? 1u : 0u;
        path.refracted += path.alive && !reflected ? 1u : 0u;
        path.ray = next;
        path.bounce += 1u;
      }
    } else {
      path.radiance += path.throughput * (path.bounce == 0u ? background_radiance(path.ray.dir)
                                                             : environment_radiance(path.ray.dir));
      path.leaked = path.ray.inside != 0u ? 1u : 0u;
      path.alive = false;
    }
  } while (path.alive);
}

#endif
