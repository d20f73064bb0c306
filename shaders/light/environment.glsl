// Light from all around. Needs `frame`, environment_texel(position) and the constant ENVIRONMENT.
#ifndef SPLATRAY_ENVIRONMENT_GLSL
#define SPLATRAY_ENVIRONMENT_GLSL
#include "lang/language.glsl"

/// A world direction in the environment's own frame.
vec3 to_environment(vec3 dir) {
  vec3 up = frame.environment_up;
  vec3 right = frame.environment_right;
  return vec3(dot(dir, right), dot(dir, up), dot(dir, cross(right, up)));
}

/// The other way round.
vec3 from_environment(vec3 dir) {
  vec3 up = frame.environment_up;
  vec3 right = frame.environment_right;
  return right * dir.x + up * dir.y + cross(right, up) * dir.z;
}

/// Where the latitude-longitude image has this direction of its own frame (engine/scene/environment.h): column and row, 0..1.
vec2 environment_position(vec3 dir) {
  float column = atan(dir.x, -dir.z) * 0.15915494f + 0.5f;
  float row = acos(clamp(dir.y, -1.0f, 1.0f)) * 0.31830989f;
  return vec2(column, row);
}

/// Radiance from where environment_position() has a direction; ENVIRONMENT alone.
vec3 environment_at(vec2 position) { return frame.environment * environment_texel(position); }

/// Radiance from the environment.
vec3 environment_radiance(vec3 dir) {
  if (ENVIRONMENT) return environment_at(environment_position(to_environment(dir)));
  return frame.environment;
}

/// What a primary ray that meets nothing sees.
vec3 background_radiance(vec3 dir) {
  return frame.background.x < 0.0f ? environment_radiance(dir) : frame.background;
}

/// What a white diffuse surface of this normal sends out under the environment alone (Ramamoorthi and Hanrahan 2001, "An
/// Efficient Representation for Irradiance Environment Maps").
vec3 environment_diffuse(vec3 normal) {
  vec3 n = to_environment(normal);
  vec4 sum = frame.irradiance[0] + frame.irradiance[1] * n.y + frame.irradiance[2] * n.z +
             frame.irradiance[3] * n.x + frame.irradiance[4] * (n.x * n.y) + frame.irradiance[5] * (n.y * n.z) +
             frame.irradiance[6] * (3.0f * n.z * n.z - 1.0f) + frame.irradiance[7] * (n.x * n.z) +
             frame.irradiance[8] * (n.x * n.x - n.y * n.y);
  return max(vec3(sum.x, sum.y, sum.z), vec3(0.0f));
}

#endif
