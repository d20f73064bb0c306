// Which splats of a leaf's list a ray hits, decided exactly: each hit counts in one leaf, so what is found depends on the splats
// alone, not on the tree. Needs, beside walk.glsl: splat_words(splat), clip_word(splat), material_at(object), and the constants
// BLEND, SIDE, FACES, CLIPS, ELLIPSES, with FACES_CUT cut_eye(), and what factors.glsl and region.glsl need.
#ifndef SPLATRAY_ACCEPT_GLSL
#define SPLATRAY_ACCEPT_GLSL
#include "trace/factors.glsl"
#include "trace/walk.glsl"

/// The splat that decides the cluster, while the ray looks for it.
struct First {
  vec2 measure;   ///< least t, or least squared distance from the centre / r^2 (BLEND_PAPER, BLEND_LEAF)
  vec2 t;         ///< in double-float: float32 would be off by 2^-4 lattice units on the far side of the root
  vec3 from_center;
  bool front;
  uvec4 words;
  uint splat;     ///< its index in the data pool
};

First no_first() {
  First first;
  first.measure = vec2(INFINITY_F, INFINITY_F);
  first.t = vec2(INFINITY_F, 0.0f);
  first.from_center = vec3(0.0f);
  first.front = true;
  first.words = uvec4(0u, 0u, 0u, 0u);
  first.splat = 0u;
  return first;
}

/// With a region all that is opaque is: whoever looks into a body that is cut open sees it from behind.
bool is_two_sided(uint object) {
  if (FACES == FACES_BOTH || FACES == FACES_CUT) return true;
  if (FACES == FACES_FRONT) return false;
  uint flags = MATERIAL_TWO_SIDED;
  if (FACES == FACES_OPAQUE) flags |= MATERIAL_DIELECTRIC;
  uint own = material_at(object).flags;
  return (own & flags) != 0u || (REGION && (own & MATERIAL_DIELECTRIC) == 0u);
}

/// The side a ray expects (Goradia et al. 2010, sec. IV-C2, made per object): fronts outside, backs inside.
bool side_expected(uint object, float facing, uint inside) {
  if (FACES == FACES_BOTH || FACES == FACES_CUT) return true;
  if (FACES == FACES_FRONT) return SIDE != SIDE_SIDE || facing < 0.0f;
  Material material = material_at(object);
  bool is_inside = (material.flags & MATERIAL_DIELECTRIC) != 0u && ((inside >> material.mask_bit) & 1u) != 0u;
  bool as_expected = is_inside ? facing > 0.0f : facing < 0.0f;
  return (material.flags & MATERIAL_HIDDEN) == 0u && (SIDE != SIDE_SIDE || is_two_sided(object) || as_expected);
}

/// Whether a splat turns its front to the eye, and so is there in a picture that leaves all else out (FACES_CUT). Of whole
/// splats, not of rays: what hides a room from the eye keeps no light from it either.
bool faces_eye(uvec4 words) { return dot(splat_normal(words), cut_eye() - splat_center(words)) > 0.0f; }

/// Everything but the geometry that a hit needs in order to count.
bool hit_allowed(uvec4 words, PlaneHit hit, Ray ray) {
  if (FACES == FACES_CUT && !faces_eye(words)) return false;
  uint object = splat_object(words);
  bool own = false;
  if (SIDE == SIDE_SIDE) own = ray.from_object != NO_OBJECT && splat_of_sheet_left(words, ray, is_two_sided(object));
  return !own && side_expected(object, hit.facing, ray.inside);
}

/// Where a ray meets a splat's plane, measured as the splat's shape has it.
PlaneHit meet_splat(uint splat, uvec4 words, Ray ray) {
  PlaneHit hit = splat_plane_hit(words, ray.origin, ray.origin_low, ray.dir);
  if (ELLIPSES) hit = ellipse_hit(clip_word(splat), words, hit);
  return hit;
}

/// Whether a meeting is on the part of the splat's plane that its clip lines leave.
bool clip_keeps(uint clip, uvec4 words, PlaneHit hit) {
#ifdef HOST
  if (clip == CLIP_NONE) return true;
#endif
  bool single = ELLIPSES && is_ellipse(clip);
  return line_keeps(clip, words, hit) && (single || line_keeps(clip >> 16u, words, hit));
}

/// Whether a meeting with a disc's plane is a hit on the disc that counts in an interval [t_in, t_out) of the ray.
bool hit_accepted(uvec4 words, uint splat, PlaneHit hit, Ray ray, float t_in, float t_out) {
  bool on_disc =
      !df_less(vec2(splat_radius_squared(words), 0.0f), hit.rho_squared) && hit.rho_squared.x >= 0.0f;
  bool in_range = hit.t.x >= t_in && hit.t.x < t_out && hit.t.x > ray.t_min && hit.t.x < ray.t_max;
  bool kept = true;
  if (REGION) kept = region_keeps(ray, hit.t.x);
  if (CLIPS) kept = kept && clip_keeps(clip_word(splat), words, hit);
#ifndef LIT
  // Without paths there is no chance to be had: what is see-through is cut out.
  if (OPACITY) kept = kept && opacity_at(splat) >= 0.5f;
#endif
  return on_disc && in_range && kept && hit_allowed(words, hit, ray);
}

/// Makes a hit the first one, if it comes before that; `wanted`: else never.
void take_first(uint splat, uvec4 words, PlaneHit hit, bool wanted, INOUT(First) first) {
  vec2 measure = hit.t;
  if (BLEND == BLEND_PAPER || BLEND == BLEND_LEAF)
    measure = vec2(hit.rho_squared.x / splat_radius_squared(words), 0.0f);
  bool before = df_less(measure, first.measure) ||
                (measure.x == first.measure.x && measure.y == first.measure.y && words_less(words, first.words));
  if (wanted && before) {
    first.measure = measure;
    first.t = hit.t;
    first.from_center = hit.from_center;
    first.front = hit.facing < 0.0f;
    first.words = words;
    first.splat = splat;
  }
}

/// The candidates that are hits. `first` is updated while `finding`.
uint accept_candidates(uint chunk, uint candidates, Ray ray, Walk walk, bool finding, INOUT(First) first) {
  uint accepted = 0u;
  do {
    if (candidates != 0u) {
      uint bit = uint(findLSB(candidates));
      candidates &= candidates - 1u;
      uint splat = splat_at(chunk + bit);
      uvec4 words = splat_words(splat);
      PlaneHit hit = meet_splat(splat, words, ray);
      bool accept = hit_accepted(words, splat, hit, ray, walk.t_in, walk.t_out);
      accepted |= (accept ? 1u : 0u) << bit;
      take_first(splat, words, hit, accept && finding, first);
    }
  } while (candidates != 0u);
  return accepted;
}

#endif
