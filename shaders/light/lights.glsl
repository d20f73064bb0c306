// Light of the scene's lights at a hit, with shadows: Phong. Needs `frame`, light_at(index) and the constant SHADOWS.
#ifndef SPLATRAY_LIGHTS_GLSL
#define SPLATRAY_LIGHTS_GLSL
#include "light/falloff.glsl"
#include "light/material.glsl"
#include "light/sampling.glsl"
#include "trace/shadow.glsl"

/// Phong shading of the hit by the dispatch's lights: diffuse / pi and the energy-normalised specular lobe, per unit irradiance.
/// Where `scatters` is false no ray is traced: the sum is of no use.
vec3 shade_lights(Hit hit, vec3 view_dir, vec3 diffuse, Phong phong, uint inside, bool scatters,
                  INOUT(uint) shadow_rays, INOUT(Tally) tally) {
  vec3 mirrored = reflect(view_dir, hit.normal);
  vec3 sum = vec3(0.0f);
  uint index = frame.light_begin;
  do {
    Light light = light_at(index);
    bool point = light.kind == LIGHT_POINT;
    vec3 to_light = point ? light.position - hit.position : light.position;
    float distance_squared = point ? max(dot(to_light, to_light), 1.0f) : 1.0f;
    float light_distance = sqrt(distance_squared);
    vec3 dir = to_light * (1.0f / light_distance);
    float cosine = dot(hit.normal, dir);
    bool lit = scatters && cosine > 0.0f;
    vec3 visible = vec3(lit ? 1.0f : 0.0f);
    if (SHADOWS) {
      Ray ray = ray_from_hit(hit, dir, inside);
      ray.t_max = point ? light_distance : INFINITY_F;
      ray.t_max = lit ? ray.t_max : -1.0f;
      visible *= trace_shadow(ray, tally).light;
      shadow_rays += lit ? 1u : 0u;
    }
    float falloff = point ? light_falloff(light, dir, distance_squared) : 1.0f;
    vec3 irradiance = light.power * (falloff * max(cosine, 0.0f) / distance_squared);
    float lobe = pow(max(dot(mirrored, dir), 1e-4f), phong.shininess) * (phong.shininess + 2.0f) * 0.5f;
    sum += visible * irradiance * (diffuse + vec3(phong.specular * lobe)) * (1.0f / PI);
    index += 1u;
  } while (index < frame.light_end);
  return sum;
}

#endif
