// Rough dielectric boundaries (Walter et al. 2007, sec. 5.2 and 5.3). Radiance is per squared index of refraction, so that
// crossing a boundary alone changes none. Needs microfacet.glsl and albedo_at(index).
#ifndef SPLATRAY_GLASS_GLSL
#define SPLATRAY_GLASS_GLSL
#include "light/albedo.glsl"

/// What one bounce on the facets leaves of white light, sent back and through: value and probability of a direction, |cosine|
/// included.
float glass_value(vec3 to_eye, vec3 to_light, float alpha, float eta, OUT(float) pdf) {
  bool back = to_light.z > 0.0f;
  vec3 bent = to_eye * eta + to_light;
  vec3 half_way = back ? to_eye + to_light : (eta < 1.0f ? -bent : bent);
  half_way *= inversesqrt(max(dot(half_way, half_way), 1e-30f));
  float eye_cosine = dot(to_eye, half_way);
  float light_cosine = dot(to_light, half_way);
  float behind = 0.0f;
  float share = fresnel(eta, clamp(eye_cosine, 1e-6f, 1.0f), behind);
  float facets = ggx_mirrored_pdf(to_eye, half_way, alpha, 1.0f);  // a quarter of a facet's probability over eye_cosine
  float bend = eta * eye_cosine + light_cosine;
  float through = 4.0f * eye_cosine * -light_cosine / max(bend * bend, 1e-30f);
  bool possible = half_way.z > 0.0f && eye_cosine > 0.0f && (back ? light_cosine > 0.0f : light_cosine < 0.0f);
  pdf = possible ? facets * (back ? share : (1.0f - share) * through) : 0.0f;
  float seen = back ? 2.0f * to_light.z * (to_eye.z + ggx_stretch(to_eye.z, alpha)) * ggx_visible(to_eye.z, to_light.z, alpha)
                    : ggx_seen(-to_light.z, alpha);
  return pdf * seen;
}

/// Whether the boundary sends light on in two directions alone: smooth ones do, and those that do not bend it.
bool glass_is_clear(float alpha, float eta) { return alpha < ALPHA_LEAST || abs(eta - 1.0f) < 1e-3f; }

/// A direction for it; `choice` decides between reflection and refraction, below Fresnel's share the first.
vec3 glass_sample(vec3 to_eye, float alpha, float eta, vec2 random, float choice, OUT(bool) back) {
  vec3 facet = glass_is_clear(alpha, eta) ? vec3(0.0f, 0.0f, 1.0f) : ggx_facet(to_eye, alpha, 1.0f, random);
  float cosine = clamp(dot(to_eye, facet), 1e-6f, 1.0f);
  float behind = 0.0f;
  back = choice < fresnel(eta, cosine, behind);
  return back ? facet * (2.0f * cosine) - to_eye : facet * (eta * cosine - behind) - to_eye * eta;
}

#endif
