// Points and directions that random numbers choose.
#ifndef SPLATRAY_SAMPLING_GLSL
#define SPLATRAY_SAMPLING_GLSL
#include "lang/language.glsl"

const float PI = 3.14159265f;
const float TWO_PI = 6.28318531f;
const float INVERSE_PI = 0.31830989f;

/// Two unit vectors that are perpendicular to a third and to each other (Duff et al. 2017, "Building an Orthonormal Basis,
/// Revisited").
struct Basis {
  vec3 u;
  vec3 v;
};
Basis basis_of(vec3 normal) {
  float side = normal.z >= 0.0f ? 1.0f : -1.0f;
  float a = -1.0f / (side + normal.z);
  float b = normal.x * normal.y * a;
  Basis basis;
  basis.u = vec3(1.0f + side * normal.x * normal.x * a, side * b, -side * normal.x);
  basis.v = vec3(b, side + normal.y * normal.y * a, -normal.y);
  return basis;
}

/// A point of the unit disc, evenly (Shirley and Chiu 1997, "A Low Distortion Map Between Disk and Square").
vec2 disc_sample(vec2 random) {
  vec2 at = 2.0f * random - vec2(1.0f);
  bool wide = abs(at.x) > abs(at.y);
  float radius = wide ? at.x : at.y;
  float share = wide ? at.y / at.x : (at.y != 0.0f ? at.x / at.y : 0.0f);
  float angle = wide ? 0.78539816f * share : 1.57079633f - 0.78539816f * share;
  return radius * vec2(cos(angle), sin(angle));
}

/// A direction of the cone about `axis`, evenly; `height` = 1 - the cosine of the cone's angle, in (0, 2].
vec3 cone_sample(vec3 axis, float height, vec2 random) {
  float below = random.x * height;
  float sine = sqrt(max(below * (2.0f - below), 0.0f));
  float angle = TWO_PI * random.y;
  Basis basis = basis_of(axis);
  return basis.u * (sine * cos(angle)) + basis.v * (sine * sin(angle)) + axis * (1.0f - below);
}

/// 1 - the cosine of an angle with this sine, without cancellation; 2, the whole sphere, where there is none.
float cone_height(float sine_squared) {
  return sine_squared < 1.0f ? sine_squared / (1.0f + sqrt(1.0f - sine_squared)) : 2.0f;
}

#endif
