// How a surface scatters light: glTF 2.0's metallic-roughness model with its layers' energy kept. A rough layer that mirrors lies
// over a diffuse base, which gets what the layer lets through, and sends back what it lets out again (Ashikhmin and Shirley 2000,
// "An Anisotropic Phong Light Reflection Model", eq. 5; here by the albedo table); metals get back what facets hide from each
// other (Kulla and Conty 2017, "Revisiting Physically Based Shading at Imageworks"); rough glass is brightened by as much as one
// bounce loses, and a coat takes its part on the eye's side alone: these two are not reciprocal, all else is. Needs
// albedo_at(index) and the constants LOBE_DIFFUSE, LOBE_SPECULAR, LOBE_METAL, LOBE_TRANSMISSION, LOBE_COAT: what no surface has
// is not compiled.
#ifndef SPLATRAY_BSDF_GLSL
#define SPLATRAY_BSDF_GLSL
#include "light/glass.glsl"

const uint BSDF_REFLECTED = 1u;
const uint BSDF_TRANSMITTED = 2u;
const uint BSDF_DELTA = 4u;  ///< a mirror's or clear glass's one direction

const float COAT_F0 = 0.04f;          ///< of index 1.5
const float SCHLICK_MEAN = 0.04761905f;  ///< 1/21: schlick's mean over all directions, weighted by cosine

/// A surface, seen from one direction. Local frame: +z is the normal, on the eye's side.
struct Bsdf {
  vec3 base;           ///< base colour, 0..1
  float metallic;      ///< 0..1
  vec3 f0;             ///< reflectance of what is no metal, seen face on, 0..1
  float f90;           ///< and edge on, 0..1
  float alpha;         ///< GGX roughness, 0..1
  float transmission;  ///< share of what is no metal that is glass, 0..1
  float eta;           ///< index of refraction on the eye's side over that behind
  vec3 tint;           ///< of light that goes through the glass, 0..1
  float coat;          ///< clearcoat, 0..1
  float coat_alpha;
  // bsdf_seen() makes the rest.
  vec3 diffuse;        ///< diffuse reflectance but for what the layer takes of light on its way in
  vec3 again;          ///< what facets of metal hide, likewise
  vec3 mirrored;       ///< what the layer reflects in all
  float below;         ///< share of light that passes the coat
  float coat_chosen;   ///< how often the coat's direction is chosen; of the rest glass's, and of the rest the layer's
  float glass_chosen;
  float layer_chosen;
};

/// What a material and a splat's colour say; bsdf_seen() makes the rest.
Bsdf bsdf_of(Material material, vec3 color, float eta) {
  Bsdf bsdf;
  bsdf.base = material.base * color;
  bsdf.metallic = material.metallic;
  float ior = LOBE_TRANSMISSION && material.transmission > 0.0f ? eta : material.layer_ior;
  float facing = (ior - 1.0f) / (ior + 1.0f);
  bsdf.f0 = min(material.specular_color * (facing * facing * material.specular), vec3(1.0f));
  bsdf.f90 = material.specular;
  bsdf.alpha = material.roughness * material.roughness;
  bsdf.transmission = material.transmission;
  bsdf.eta = eta;
  bsdf.tint = bsdf.base;
  bsdf.coat = material.coat;
  bsdf.coat_alpha = material.coat_roughness * material.coat_roughness;
  return bsdf;
}

float mean_of(vec3 color) { return (color.x + color.y + color.z) * (1.0f / 3.0f); }

/// Works out what depends on the cosine of the eye's direction alone.
void bsdf_seen(INOUT(Bsdf) bsdf, float cosine) {
  bsdf.diffuse = bsdf.base;
  bsdf.again = vec3(0.0f);
  bsdf.mirrored = vec3(0.0f);
  bsdf.below = 1.0f;
  bsdf.coat_chosen = 0.0f;
  bsdf.glass_chosen = 0.0f;
  bsdf.layer_chosen = 0.0f;
  if (LOBE_SPECULAR || LOBE_METAL || LOBE_TRANSMISSION) {
    vec2 factors = albedo_factors(cosine, bsdf.alpha);
    vec2 means = albedo_means(bsdf.alpha);
    float dull = 1.0f - bsdf.metallic;
    bsdf.glass_chosen = LOBE_TRANSMISSION ? dull * bsdf.transmission : 0.0f;
    dull -= bsdf.glass_chosen;
    vec3 layer = bsdf.f0 * factors.x + vec3(bsdf.f90 * factors.y);
    vec3 layer_mean = bsdf.f0 * means.x + vec3(bsdf.f90 * means.y);
    vec3 passes = max(vec3(1.0f) - layer_mean, vec3(1e-4f));
    bsdf.diffuse *= dull * (vec3(1.0f) - layer) / passes;
    bsdf.mirrored = layer * dull;
    float scattered = mean_of(bsdf.diffuse * passes);
    if (LOBE_METAL) {
      vec3 fresnel_mean = bsdf.base + (vec3(1.0f) - bsdf.base) * SCHLICK_MEAN;
      float seen_mean = means.x + means.y;
      vec3 kept = fresnel_mean * fresnel_mean * seen_mean / (vec3(1.0f) - fresnel_mean * (1.0f - seen_mean));
      float hidden = bsdf.metallic * max(1.0f - factors.x - factors.y, 0.0f);
      bsdf.again = kept * (hidden / max(1.0f - seen_mean, 1e-7f));
      scattered += mean_of(kept) * hidden;
      bsdf.mirrored += (bsdf.base * factors.x + vec3(factors.y)) * bsdf.metallic;
    }
    float mirrored = mean_of(bsdf.mirrored);
    bsdf.layer_chosen = mirrored > 0.0f ? mirrored / (mirrored + scattered) : 0.0f;
    if (!LOBE_DIFFUSE && !LOBE_METAL) bsdf.layer_chosen = 1.0f;
  }
  if (LOBE_COAT) {
    vec2 factors = albedo_factors(cosine, bsdf.coat_alpha);
    bsdf.coat_chosen = bsdf.coat * (COAT_F0 * factors.x + factors.y);
    bsdf.below = 1.0f - bsdf.coat_chosen;
  }
}

/// Value times |cosine| towards to_eye of light from to_light, both unit; without what is delta. `pdf`: bsdf_sample's probability
/// of it.
vec3 bsdf_value(Bsdf bsdf, vec3 to_eye, vec3 to_light, OUT(float) pdf) {
  bool above = to_light.z > 0.0f;
  float cosine = max(to_light.z, 0.0f);
  vec3 value = bsdf.diffuse;
  pdf = (1.0f - bsdf.layer_chosen) * cosine * INVERSE_PI;
  vec3 half_way = to_eye + to_light;
  half_way *= inversesqrt(max(dot(half_way, half_way), 1e-30f));
  if (LOBE_SPECULAR || LOBE_METAL || LOBE_TRANSMISSION) {
    vec2 factors = albedo_factors(cosine, bsdf.alpha);
    value *= vec3(1.0f) - bsdf.f0 * factors.x - vec3(bsdf.f90 * factors.y);
    if (LOBE_METAL) value += bsdf.again * max(1.0f - factors.x - factors.y, 0.0f);
  }
  value *= cosine * INVERSE_PI;
  if (LOBE_SPECULAR || LOBE_METAL) {
    float edge = schlick(dot(to_light, half_way));
    vec3 reflectance = (bsdf.f0 + (vec3(bsdf.f90) - bsdf.f0) * edge) * (1.0f - bsdf.metallic - bsdf.glass_chosen);
    if (LOBE_METAL) reflectance += (bsdf.base + (vec3(1.0f) - bsdf.base) * edge) * bsdf.metallic;
    float alpha = max(bsdf.alpha, ALPHA_LEAST);
    float facets = ggx_density(half_way, alpha) * ggx_visible(to_eye.z, cosine, alpha) * cosine;
    float chosen = ggx_mirrored_pdf(to_eye, half_way, alpha, ggx_bound(to_eye, alpha));
    bool rough = bsdf.alpha >= ALPHA_LEAST && above;
    value += rough ? reflectance * facets : vec3(0.0f);
    pdf += rough ? bsdf.layer_chosen * chosen : 0.0f;
  }
  if (LOBE_TRANSMISSION) {
    pdf *= 1.0f - bsdf.glass_chosen;
    if (bsdf.glass_chosen > 0.0f && !glass_is_clear(bsdf.alpha, bsdf.eta)) {
      float glass_pdf = 0.0f;
      float glass = glass_value(to_eye, to_light, bsdf.alpha, bsdf.eta, glass_pdf);
      vec3 tint = above ? vec3(1.0f) : bsdf.tint;
      value += tint * (glass * bsdf.glass_chosen / albedo_of_glass(to_eye.z, bsdf.alpha, bsdf.eta));
      pdf += bsdf.glass_chosen * glass_pdf;
    }
  }
  if (LOBE_COAT) {
    value *= bsdf.below;
    pdf *= 1.0f - bsdf.coat_chosen;
    float alpha = max(bsdf.coat_alpha, ALPHA_LEAST);
    float reflectance = bsdf.coat * (COAT_F0 + (1.0f - COAT_F0) * schlick(dot(to_light, half_way)));
    float facets = ggx_density(half_way, alpha) * ggx_visible(to_eye.z, cosine, alpha) * cosine;
    float chosen = ggx_mirrored_pdf(to_eye, half_way, alpha, ggx_bound(to_eye, alpha));
    bool rough = bsdf.coat_alpha >= ALPHA_LEAST && above && bsdf.coat > 0.0f;
    value += rough ? vec3(reflectance * facets) : vec3(0.0f);
    pdf += rough ? bsdf.coat_chosen * chosen : 0.0f;
  }
  return value;
}

/// A direction that light may come from.
struct BsdfSample {
  vec3 dir;     ///< unit
  vec3 weight;  ///< value * |cosine| / pdf; 0 where nothing comes
  float pdf;    ///< per solid angle; 0 of delta events
  uint event;   ///< BSDF_REFLECTED or BSDF_TRANSMITTED, and BSDF_DELTA
};

vec3 mirrored_about(vec3 dir, vec3 facet) { return facet * (2.0f * dot(dir, facet)) - dir; }

/// A number in [0, 1) anew from one that is, or is not, below `share`.
float used_again(float number, float share, bool below) {
  float again = below ? number / share : (number - share) / (1.0f - share);
  return clamp(again, 0.0f, 0.99999994f);
}

/// How often bsdf_direction chooses a direction that is no delta event's.
float bsdf_scatters(Bsdf bsdf) {
  float layer = bsdf.alpha < ALPHA_LEAST ? 1.0f - bsdf.layer_chosen : 1.0f;
  float glass = glass_is_clear(bsdf.alpha, bsdf.eta) ? 0.0f : 1.0f;
  float below = layer + (glass - layer) * bsdf.glass_chosen;
  float coat = bsdf.coat_alpha < ALPHA_LEAST ? 0.0f : 1.0f;
  return below + (coat - below) * bsdf.coat_chosen;
}

/// A direction, and the weight of delta events. random.x chooses the lobe, and what is left of it, with random.y, the direction;
/// random.z whether light is reflected or refracted.
BsdfSample bsdf_direction(Bsdf bsdf, vec3 to_eye, vec3 random) {
  float x = random.x;
  bool coat = LOBE_COAT && x < bsdf.coat_chosen;
  if (LOBE_COAT) x = used_again(x, bsdf.coat_chosen, coat);
  bool glass = LOBE_TRANSMISSION && !coat && x < bsdf.glass_chosen;
  if (LOBE_TRANSMISSION && !coat) x = used_again(x, bsdf.glass_chosen, glass);
  bool layer = !coat && !glass && x < bsdf.layer_chosen;
  if ((LOBE_SPECULAR || LOBE_METAL) && !coat && !glass) x = used_again(x, bsdf.layer_chosen, layer);
  vec2 within = vec2(x, random.y);
  vec2 at = disc_sample(within);
  BsdfSample chosen;
  chosen.dir = vec3(at, sqrt(max(1.0f - dot(at, at), 0.0f)));
  chosen.event = BSDF_REFLECTED;
  chosen.weight = vec3(1.0f);
  chosen.pdf = 0.0f;
  if (!LOBE_SPECULAR && !LOBE_METAL && !LOBE_TRANSMISSION && !LOBE_COAT) return chosen;
  float alpha = coat ? bsdf.coat_alpha : bsdf.alpha;
  bool smooth_lobe = alpha < ALPHA_LEAST && (coat || layer);
  if (LOBE_TRANSMISSION) smooth_lobe = smooth_lobe || (glass && glass_is_clear(alpha, bsdf.eta));
  if (coat || layer) {
    vec3 facet = smooth_lobe ? vec3(0.0f, 0.0f, 1.0f)
                             : ggx_facet(to_eye, alpha, ggx_bound(to_eye, alpha), within);
    chosen.dir = mirrored_about(to_eye, facet);
    chosen.weight = coat ? vec3(1.0f) : bsdf.mirrored / (bsdf.layer_chosen * (1.0f - bsdf.glass_chosen));
  }
  if (LOBE_TRANSMISSION && glass) {
    bool back = true;
    chosen.dir = glass_sample(to_eye, alpha, bsdf.eta, within, random.z, back);
    chosen.event = back ? BSDF_REFLECTED : BSDF_TRANSMITTED;
    chosen.weight = back ? vec3(1.0f) : bsdf.tint;
  }
  if (smooth_lobe) chosen.event |= BSDF_DELTA;
  return chosen;
}

/// Gives a direction chosen its probability, as bsdf_direction's, and weight; those of delta events are left.
void bsdf_weigh(Bsdf bsdf, vec3 to_eye, INOUT(BsdfSample) chosen) {
  bool possible = ((chosen.event & BSDF_REFLECTED) != 0u) == (chosen.dir.z > 0.0f);
  if (!LOBE_SPECULAR && !LOBE_METAL && !LOBE_TRANSMISSION && !LOBE_COAT) {
    chosen.weight = bsdf.base;
    chosen.pdf = max(chosen.dir.z, 0.0f) * INVERSE_PI;
  } else if ((chosen.event & BSDF_DELTA) == 0u) {
    vec3 value = bsdf_value(bsdf, to_eye, chosen.dir, chosen.pdf);
    chosen.weight = chosen.pdf > 0.0f ? value / chosen.pdf : vec3(0.0f);
  }
  chosen.weight = possible ? chosen.weight : vec3(0.0f);
}

/// A direction with its weight.
BsdfSample bsdf_sample(Bsdf bsdf, vec3 to_eye, vec3 random) {
  BsdfSample chosen = bsdf_direction(bsdf, to_eye, random);
  bsdf_weigh(bsdf, to_eye, chosen);
  return chosen;
}

#endif
