// Reads the albedo table. Needs albedo_at(index).
#ifndef SPLATRAY_ALBEDO_GLSL
#define SPLATRAY_ALBEDO_GLSL
#include "lang/albedo_layout.h"
#include "light/microfacet.glsl"

const float ALBEDO_ETA_MOST = 0.4285715f;  ///< eta 0.4 to 2.5

/// Where a cosine and a roughness lie in a table: the first of four entries, and how far on towards the next.
struct AlbedoPlace {
  uint first;
  vec2 on;
};
AlbedoPlace albedo_place(float cosine, float alpha) {
  float width = max(alpha, 1e-3f);
  float x = log(1.0f + cosine / width) / log(1.0f + 1.0f / width);
  x = clamp(x * float(ALBEDO_COLUMNS - 1u), 0.0f, float(ALBEDO_COLUMNS - 1u) - 1e-3f);
  float y = clamp(sqrt(alpha) * float(ALBEDO_ROWS - 1u), 0.0f, float(ALBEDO_ROWS - 1u) - 1e-3f);
  AlbedoPlace place;
  place.first = uint(y) * ALBEDO_COLUMNS + uint(x);
  place.on = vec2(x - floor(x), y - floor(y));
  return place;
}

float albedo_between(uint first, uint step, AlbedoPlace place) {
  uint next = first + step * ALBEDO_COLUMNS;
  float low = albedo_at(first) + (albedo_at(first + step) - albedo_at(first)) * place.on.x;
  float high = albedo_at(next) + (albedo_at(next + step) - albedo_at(next)) * place.on.x;
  return low + (high - low) * place.on.y;
}

/// The factors of f0 and f90 in what a rough surface reflects in all.
vec2 albedo_factors(float cosine, float alpha) {
  float edge = schlick(cosine);
  if (alpha < ALPHA_LEAST) return vec2(1.0f - edge, edge);
  AlbedoPlace place = albedo_place(cosine, alpha);
  float all = albedo_between(2u * place.first, 2u, place);
  float high = clamp(edge * all + albedo_between(2u * place.first + 1u, 2u, place), 0.0f, all);
  return vec2(all - high, high);
}

/// Their means over all directions, weighted by cosine.
vec2 albedo_means(float alpha) {
  if (alpha < ALPHA_LEAST) return vec2(20.0f / 21.0f, 1.0f / 21.0f);
  float y = clamp(sqrt(alpha) * float(ALBEDO_ROWS - 1u), 0.0f, float(ALBEDO_ROWS - 1u) - 1e-3f);
  uint row = ALBEDO_MEANS + 2u * uint(y);
  float on = y - floor(y);
  return vec2(albedo_at(row) + (albedo_at(row + 2u) - albedo_at(row)) * on,
              albedo_at(row + 1u) + (albedo_at(row + 3u) - albedo_at(row + 1u)) * on);
}

/// What both sides of a rough dielectric send on in all.
float albedo_of_glass(float cosine, float alpha, float eta) {
  AlbedoPlace place = albedo_place(cosine, alpha);
  float z = (eta - 1.0f) / (eta + 1.0f) / ALBEDO_ETA_MOST;
  z = ((z < 0.0f ? -sqrt(-z) : sqrt(max(z, 0.0f))) + 1.0f) * (0.5f * float(ALBEDO_ETAS - 1u));
  z = clamp(z, 0.0f, float(ALBEDO_ETAS - 1u) - 1e-3f);
  uint first = ALBEDO_GLASS + uint(z) * (ALBEDO_COLUMNS * ALBEDO_ROWS) + place.first;
  float low = albedo_between(first, 1u, place);
  float high = albedo_between(first + ALBEDO_COLUMNS * ALBEDO_ROWS, 1u, place);
  return low + (high - low) * (z - floor(z));
}

#endif
