// Light at a hit: environment, lights with shadows, Phong; and the secondary rays' directions. Needs
// trace.glsl, `frame`, light_at(index), environment_texel(direction in the environment's frame), and the
// constants ENVIRONMENT, LIGHTS, SHADOWS.
#ifndef SPLATRAY_SHADE_GLSL
#define SPLATRAY_SHADE_GLSL
#include "trace/trace.glsl"

const float PI = 3.14159265f;

vec3 to_environment(vec3 dir) {
  vec3 up = frame.environment_up;
  vec3 right = frame.environment_right;
  return vec3(dot(dir, right), dot(dir, up), dot(dir, cross(right, up)));
}

/// Radiance from the environment.
vec3 environment_radiance(vec3 dir) {
  if (ENVIRONMENT == 1u) return frame.environment * environment_texel(to_environment(dir));
  return frame.environment;
}

/// What a white diffuse surface of this normal sends out under the environment alone (Ramamoorthi, Hanrahan
/// 2001).
vec3 environment_diffuse(vec3 normal) {
  vec3 n = to_environment(normal);
  vec4 sum = frame.irradiance[0] + frame.irradiance[1] * n.y + frame.irradiance[2] * n.z +
             frame.irradiance[3] * n.x + frame.irradiance[4] * (n.x * n.y) + frame.irradiance[5] * (n.y * n.z) +
             frame.irradiance[6] * (3.0f * n.z * n.z - 1.0f) + frame.irradiance[7] * (n.x * n.z) +
             frame.irradiance[8] * (n.x * n.x - n.y * n.y);
  return max(vec3(sum.x, sum.y, sum.z), vec3(0.0f));
}

/// A ray that leaves a surface. It ignores the sheet it leaves (design, section 4) or, with SIDE_DELTA, everything nearer than
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
  return ray;
}

Ray ray_from_hit(Hit hit, vec3 dir, uint inside) {
  return secondary_ray(hit.position, dir, inside, hit.front ? hit.normal : -hit.normal, hit.object);
}

/// Phong shading of the hit by all lights: diffuse / pi and the energy-normalised specular lobe, per unit
/// irradiance.
vec3 shade_lights(Hit hit, vec3 view_dir, vec3 diffuse, Material material, uint inside, INOUT(uint) shadow_rays,
                  INOUT(Tally) tally) {
  vec3 mirrored = reflect(view_dir, hit.normal);
  vec3 sum = vec3(0.0f);
  uint index = 0u;
  do {
    Light light = light_at(index);
    bool point = light.kind == LIGHT_POINT;
    vec3 to_light = point ? light.position - hit.position : light.position;
    float distance_squared = point ? max(dot(to_light, to_light), 1.0f) : 1.0f;
    float light_distance = sqrt(distance_squared);
    vec3 dir = to_light * (1.0f / light_distance);
    float cosine = dot(hit.normal, dir);
    vec3 visible = vec3(cosine > 0.0f ? 1.0f : 0.0f);
    if (SHADOWS == 1u) {
      Ray ray = ray_from_hit(hit, dir, inside);
      ray.t_max = point ? light_distance : INFINITY_F;
      ray.t_max = cosine > 0.0f ? ray.t_max : -1.0f;
      visible *= trace_shadow(ray, tally);
      shadow_rays += cosine > 0.0f ? 1u : 0u;
    }
    vec3 irradiance = light.power * (max(cosine, 0.0f) / distance_squared);
    float lobe = pow(max(dot(mirrored, dir), 1e-4f), material.shininess) * (material.shininess + 2.0f) * 0.5f;
    sum += visible * irradiance * (diffuse + vec3(material.specular * lobe)) * (1.0f / PI);
    index += 1u;
  } while (index < frame.light_count);
  return sum;
}

/// Share of unpolarised light that a dielectric boundary reflects; 1 on total internal reflection. `eta` =
/// ior on the ray's side / ior behind, `cosine` = |n.d|. `cosine_behind` is the refracted ray's |n.d|, 0 when
/// there is none.
float fresnel(float eta, float cosine, OUT(float) cosine_behind) {
  float sine_squared = eta * eta * max(1.0f - cosine * cosine, 0.0f);
  cosine_behind = sqrt(max(1.0f - sine_squared, 0.0f));
  float parallel = (cosine - eta * cosine_behind) / (cosine + eta * cosine_behind);
  float perpendicular = (eta * cosine - cosine_behind) / (eta * cosine + cosine_behind);
  return sine_squared >= 1.0f ? 1.0f : 0.5f * (parallel * parallel + perpendicular * perpendicular);
}

#endif
