// Tone curves that mix channels: linear to linear, 0..1 (app/library/display_image.h says whose they are).
#ifndef SPLATRAY_TONE_GLSL
#define SPLATRAY_TONE_GLSL
#include "../lang/language.glsl"

/// Khronos PBR Neutral's published formula and constants.
vec3 tone_neutral(vec3 color) {
  const float START = 0.8f - 0.04f;
  const float DESATURATION = 0.15f;
  const float ROOM = 1.0f - START;
  float least = min(min(color.x, color.y), color.z);
  color -= vec3(least < 0.08f ? least - 6.25f * least * least : 0.04f);
  float peak = max(max(color.x, color.y), color.z);
  if (peak < START) return clamp(color, vec3(0.0f), vec3(1.0f));
  float lowered = 1.0f - ROOM * ROOM / (peak + ROOM - START);
  float faded = 1.0f - 1.0f / (DESATURATION * (peak - lowered) + 1.0f);
  return clamp(mix(color * (lowered / peak), vec3(lowered), faded), vec3(0.0f), vec3(1.0f));
}

/// AgX's matrices and range of stops, its curve as a polynomial.
vec3 tone_agx(vec3 color) {
  const mat3 INSET = mat3(0.842479062253094f, 0.0423282422610123f, 0.0423756549057051f, 0.0784335999999992f,
                          0.878468636469772f, 0.0784336f, 0.0792237451477643f, 0.0791661274605434f,
                          0.879142973793104f);
  const mat3 OUTSET = mat3(1.19687900512017f, -0.0528968517574562f, -0.0529716355144438f, -0.0980208811401368f,
                           1.15190312990417f, -0.0980434501171241f, -0.0990297440797205f,
                           -0.0989611768448433f, 1.15107367264116f);
  const float LEAST_EV = -12.47393f;
  const float MOST_EV = 4.026069f;
  vec3 inside = max(INSET * color, vec3(1e-10f));
  vec3 x = (clamp(log2(inside), vec3(LEAST_EV), vec3(MOST_EV)) - LEAST_EV) / (MOST_EV - LEAST_EV);
  vec3 x2 = x * x;
  vec3 x4 = x2 * x2;
  vec3 curve = 15.5f * x4 * x2 - 40.14f * x4 * x + 31.96f * x4 - 6.868f * x2 * x + 0.4298f * x2 + 0.1191f * x -
               0.00232f;
  return clamp(pow(max(OUTSET * curve, vec3(0.0f)), vec3(2.2f)), vec3(0.0f), vec3(1.0f));
}

/// What is not a number, and what is negative, is black; infinity the largest number whose square is one.
float tone_usable(float radiance) { return radiance > 0.0f ? min(radiance, 1e18f) : 0.0f; }
vec3 tone_usable(vec3 radiance) {
  return vec3(tone_usable(radiance.x), tone_usable(radiance.y), tone_usable(radiance.z));
}

#endif
