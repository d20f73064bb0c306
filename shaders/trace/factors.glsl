// What textures make of a splat's surface, as layout.h draws it: factors on the surface's values, blended over a cluster as
// colours are. Needs texture_word(index) and the constants OPACITY, TEXTURE_LAYER, TEXTURE_GLOW, TEXTURE_COLOR, TEXTURE_NORMAL:
// words that no splat has are neither read nor summed.
#ifndef SPLATRAY_FACTORS_GLSL
#define SPLATRAY_FACTORS_GLSL
#include "primitive/disc.glsl"

struct Factors {
  vec4 layer;  ///< metallic, roughness, transmission, opacity
  vec4 glow;   ///< emission, specular
  vec4 color;  ///< specular colour, clearcoat
  float coat_roughness;
};

/// Integer sums over a cluster.
struct FactorSums {
  ivec4 layer;
  ivec4 glow;
  ivec4 color;
  int coat_roughness;
};

Factors no_factors() {
  Factors factors;
  factors.layer = vec4(1.0f);
  factors.glow = vec4(1.0f);
  factors.color = vec4(1.0f);
  factors.coat_roughness = 1.0f;
  return factors;
}

FactorSums no_factor_sums() {
  FactorSums sums;
  sums.layer = ivec4(0);
  sums.glow = ivec4(0);
  sums.color = ivec4(0);
  sums.coat_roughness = 0;
  return sums;
}

/// The four bytes of a word, 0..1.
vec4 word_bytes(uint word) {
  return vec4(float(word & 255u), float((word >> 8u) & 255u), float((word >> 16u) & 255u), float(word >> 24u)) *
         (1.0f / 255.0f);
}

/// The same where the first three are a colour's, square-root encoded.
vec4 color_bytes(uint word) {
  vec4 value = word_bytes(word);
  return value * vec4(value.x, value.y, value.z, 1.0f);
}

/// Where the texture pool has a splat's first word.
uint texture_place(uint splat) {
  return splat * ((TEXTURE_LAYER ? 1u : 0u) + (TEXTURE_GLOW ? 1u : 0u) + (TEXTURE_COLOR ? 1u : 0u) +
                  (TEXTURE_NORMAL ? 1u : 0u));
}

/// A splat's own opacity, 0..1. With OPACITY alone.
float opacity_at(uint splat) { return float(texture_word(texture_place(splat)) >> 24u) * (1.0f / 255.0f); }

/// What a normal map adds to a splat's normal, which is unit and turned against the ray: the part of the map's normal that lies
/// in the splat's plane. With TEXTURE_NORMAL alone.
vec3 tilt_at(uint splat, vec3 normal) {
  uint word = texture_word(texture_place(splat + 1u) - 1u);
  const float SCALE = float(TEXTURE_NORMAL_SCALE);
  vec3 mapped = octahedral(float(word & 4095u) - SCALE, float((word >> 12u) & 4095u) - SCALE, SCALE);
  mapped *= inversesqrt(dot(mapped, mapped));
  float cosine = dot(mapped, normal);
  vec3 tilt = cosine < 0.0f ? normal * cosine - mapped : mapped - normal * cosine;
  return (word & 0xFFFFFFu) == 0xFFFFFFu ? vec3(0.0f) : tilt;
}

/// The normal of a surface whose own is `normal`, both turned against a ray in this direction, with the mean of its splats'
/// tilts.
vec3 tilted(vec3 normal, vec3 tilt, vec3 dir) {
  const float LEAST_COSINE = 0.01f;
  vec3 along = dir * inversesqrt(dot(dir, dir));
  vec3 mapped = normal * sqrt(max(1.0f - dot(tilt, tilt), 0.0f)) + tilt;
  mapped -= along * max(dot(mapped, along) + LEAST_COSINE, 0.0f);
  return mapped * inversesqrt(dot(mapped, mapped));
}

/// The factors of one splat.
Factors factors_at(uint splat) {
  Factors factors = no_factors();
  uint layer = TEXTURE_LAYER ? 1u : 0u, glow = TEXTURE_GLOW ? 1u : 0u, color = TEXTURE_COLOR ? 1u : 0u;
  uint at = texture_place(splat);
  if (TEXTURE_LAYER) factors.layer = word_bytes(texture_word(at));
  if (TEXTURE_GLOW) factors.glow = color_bytes(texture_word(at + layer));
  if (TEXTURE_COLOR) factors.color = color_bytes(texture_word(at + layer + glow));
  if (TEXTURE_NORMAL) factors.coat_roughness = word_bytes(texture_word(at + layer + glow + color)).w;
  return factors;
}

void add_factors(INOUT(FactorSums) sums, Factors factors, float weight) {
  if (TEXTURE_LAYER) sums.layer += ivec4(factors.layer * weight + vec4(0.5f));
  if (TEXTURE_GLOW) sums.glow += ivec4(factors.glow * weight + vec4(0.5f));
  if (TEXTURE_COLOR) sums.color += ivec4(factors.color * weight + vec4(0.5f));
  if (TEXTURE_NORMAL) sums.coat_roughness += int(factors.coat_roughness * weight + 0.5f);
}

/// The cluster's, `inverse` of its weight; integers as large as the weight may be a rounding above it.
Factors mean_factors(FactorSums sums, float inverse) {
  Factors factors = no_factors();
  if (TEXTURE_LAYER) factors.layer = min(vec4(sums.layer) * inverse, vec4(1.0f));
  if (TEXTURE_GLOW) factors.glow = min(vec4(sums.glow) * inverse, vec4(1.0f));
  if (TEXTURE_COLOR) factors.color = min(vec4(sums.color) * inverse, vec4(1.0f));
  if (TEXTURE_NORMAL) factors.coat_roughness = min(float(sums.coat_roughness) * inverse, 1.0f);
  return factors;
}

/// A material as its textures have it. What it sends out, `emission`, is the material's times the splats' own factor.
Material textured(Material material, Factors factors) {
  if (TEXTURE_LAYER) {
    material.metallic *= factors.layer.x;
    material.roughness *= factors.layer.y;
    material.transmission *= factors.layer.z;
  }
  if (TEXTURE_GLOW) {
    material.emission *= vec3(factors.glow);
    material.specular *= factors.glow.w;
  }
  if (TEXTURE_COLOR) {
    material.specular_color *= vec3(factors.color);
    material.coat *= factors.color.w;
  }
  if (TEXTURE_NORMAL) material.coat_roughness *= factors.coat_roughness;
  return material;
}

#endif
