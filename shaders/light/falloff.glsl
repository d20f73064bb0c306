// Light of points that shine in a cone, or end somewhere.
#ifndef SPLATRAY_FALLOFF_GLSL
#define SPLATRAY_FALLOFF_GLSL
#include "lang/language.glsl"
#include "layout.h"

/// Share of a point light's intensity that is left where `dir` leads to it, at this squared distance (KHR_lights_punctual, "Range
/// Property" and "Inner and Outer Cone Angles").
float light_falloff(Light light, vec3 dir, float distance_squared) {
  float cone = clamp((-dot(light.spot_axis, dir) - light.spot_cosine) * light.spot_scale, 0.0f, 1.0f);
  float range = clamp(1.0f - distance_squared * distance_squared * light.range_scale, 0.0f, 1.0f);
  return (light.spot_scale > 0.0f ? cone * cone : 1.0f) * range;
}

#endif
