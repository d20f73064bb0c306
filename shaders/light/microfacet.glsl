// Rough surfaces as small mirrors: GGX, isotropic (Walter et al. 2007, "Microfacet Models for Refraction through Rough
// Surfaces"). Local frames: +z is the surface's normal, on the eye's side.
#ifndef SPLATRAY_MICROFACET_GLSL
#define SPLATRAY_MICROFACET_GLSL
#include "light/sampling.glsl"

/// Below it a surface is a mirror.
const float ALPHA_LEAST = 1e-4f;

/// How many facets face `half_way`, per solid angle and area. Written so that smooth surfaces do not cancel.
float ggx_density(vec3 half_way, float alpha) {
  float tangent = (half_way.x * half_way.x + half_way.y * half_way.y) / (alpha * alpha) + half_way.z * half_way.z;
  return 1.0f / (PI * alpha * alpha * tangent * tangent);
}

/// sqrt(alpha^2 + (1 - alpha^2) cosine^2), of which Smith's shadowing is made.
float ggx_stretch(float cosine, float alpha) {
  return sqrt(alpha * alpha + (1.0f - alpha * alpha) * cosine * cosine);
}

/// The share of facets that are seen from a direction (Smith 1967).
float ggx_seen(float cosine, float alpha) { return 2.0f * cosine / (cosine + ggx_stretch(cosine, alpha)); }

/// The share seen from both directions, over 4 cosine_eye cosine_light; heights correlated (Heitz 2014, "Understanding the
/// Masking-Shadowing Function", eq. 99).
float ggx_visible(float cosine_eye, float cosine_light, float alpha) {
  return 0.5f / (cosine_light * ggx_stretch(cosine_eye, alpha) + cosine_eye * ggx_stretch(cosine_light, alpha));
}

/// How far below the horizon of the stretched hemisphere directions reach (Eto and Tokuyoshi 2023, "Bounded VNDF Sampling for the
/// Smith-GGX BRDF").
float ggx_bound(vec3 to_eye, float alpha) {
  float reach = 1.0f + sqrt(to_eye.x * to_eye.x + to_eye.y * to_eye.y);
  float alpha_squared = alpha * alpha;
  float reach_squared = reach * reach;
  return (1.0f - alpha_squared) * reach_squared / (reach_squared + alpha_squared * to_eye.z * to_eye.z);
}

/// A facet seen from the eye (Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps"); `bound`: ggx_bound, so
/// that few mirror below the horizon, or 1 for all facets seen.
vec3 ggx_facet(vec3 to_eye, float alpha, float bound, vec2 random) {
  vec3 stretched = vec3(to_eye.x * alpha, to_eye.y * alpha, to_eye.z);
  stretched *= inversesqrt(dot(stretched, stretched));
  float below = bound * stretched.z;
  float height = (1.0f - random.y) * (1.0f + below) - below;
  float sine = sqrt(max(1.0f - height * height, 0.0f));
  float angle = TWO_PI * random.x;
  vec3 facet = stretched + vec3(sine * cos(angle), sine * sin(angle), height);
  facet = vec3(facet.x * alpha, facet.y * alpha, max(facet.z, 1e-9f));
  return facet * inversesqrt(dot(facet, facet));
}

/// The probability per solid angle with which ggx_facet's mirror sends light to the eye from a direction half_way is between.
float ggx_mirrored_pdf(vec3 to_eye, vec3 half_way, float alpha, float bound) {
  float flat_length = alpha * alpha * (to_eye.x * to_eye.x + to_eye.y * to_eye.y);
  float stretched = sqrt(flat_length + to_eye.z * to_eye.z);
  return ggx_density(half_way, alpha) / (2.0f * (bound * to_eye.z + stretched));
}

/// Share of unpolarised light that a dielectric boundary reflects; 1 on total internal reflection. `eta` = ior on the ray's side
/// / ior behind, `cosine` = |n.d|. `cosine_behind` is the refracted ray's |n.d|, 0 when there is none.
float fresnel(float eta, float cosine, OUT(float) cosine_behind) {
  float sine_squared = eta * eta * max(1.0f - cosine * cosine, 0.0f);
  cosine_behind = sqrt(max(1.0f - sine_squared, 0.0f));
  float parallel = (cosine - eta * cosine_behind) / (cosine + eta * cosine_behind);
  float perpendicular = (eta * cosine - cosine_behind) / (eta * cosine + cosine_behind);
  return sine_squared >= 1.0f ? 1.0f : 0.5f * (parallel * parallel + perpendicular * perpendicular);
}

/// (1 - cosine)^5: how far reflectance has gone from that seen face on to that seen edge on (Schlick 1994, "An Inexpensive BRDF
/// Model for Physically-Based Rendering").
float schlick(float cosine) {
  float x = clamp(1.0f - cosine, 0.0f, 1.0f);
  float x_squared = x * x;
  return x_squared * x_squared * x;
}

#endif
