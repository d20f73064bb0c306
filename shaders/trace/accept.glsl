// Which splats of a leaf's list a ray hits, decided exactly: each hit counts in one leaf, so what is found depends on the splats
// alone, not on the tree. Needs, beside walk.glsl: splat_words(splat), clip_word(splat), material_at(object), and the constants
// BLEND, SIDE, FACES, CLIPS, ELLIPSES, with FACES_CUT cut_eye(), and what factors.glsl and region.glsl need.
#ifndef SPLATRAY_ACCEPT_GLSL
#define SPLATRAY_ACCEPT_GLSL
#include "trace/factors.glsl"
#include "trace/walk.glsl"

/// The splat that decides the cluster, while the ray looks for it: that of least t or, with BLEND_PAPER and BLEND_LEAF, of least
/// squared distance from the centre / r^2.
struct First {
  vec2 t;         ///< in double-float: float32 would be off by 2^-4 lattice units on the far side of the root
  float share;    ///< squared distance / r^2; BLEND_PAPER and BLEND_LEAF only
  vec3 from_center;
  bool front;
  uvec4 words;
  uint splat;     ///< its index in the data pool
};

First no_first() {
  First first;
  first.t = vec2(INFINITY_F, 0.0f);
  first.share = INFINITY_F;
  first.from_center = vec3(0.0f);
  first.front = true;
  first.words = uvec4(0u, 0u, 0u, 0u);
  first.splat = 0u;
  return first;
}

bool is_found(First first) { return first.t.x < INFINITY_F; }

/// With a region opaque objects are two-sided: a cut body is seen from inside.
bool is_two_sided(uint object) {
  if (FACES == FACES_BOTH || FACES == FACES_CUT) return true;
  if (FACES == FACES_FRONT) return false;
  uint flags = MATERIAL_TWO_SIDED;
  if (FACES == FACES_OPAQUE) flags |= MATERIAL_DIELECTRIC;
  uint own = material_at(object).flags;
  return (own & flags) != 0u || (REGION && (own & MATERIAL_DIELECTRIC) == 0u);
}

/// Whether a dielectric does not bend light: nothing says what is behind its surface.
bool is_pane(Material material) { return (material.flags & MATERIAL_DIELECTRIC) != 0u && material.ior == 1.0f; }

/// The side a ray expects (Goradia et al. 2010, sec. IV-C2, made per object): fronts outside, backs inside.
bool side_expected(uint object, float facing, Ray ray) {
  if (FACES == FACES_BOTH || FACES == FACES_CUT) return true;
  if (FACES == FACES_FRONT) return SIDE != SIDE_SIDE || facing < 0.0f;
  Material material = material_at(object);
  bool is_inside = (material.flags & MATERIAL_DIELECTRIC) != 0u && ((ray.inside >> material.mask_bit) & 1u) != 0u;
  bool as_expected = is_inside ? facing > 0.0f : facing < 0.0f;
  if (!as_expected && PANES) as_expected = ray.to_light && is_pane(material);
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
  return !own && side_expected(object, hit.facing, ray);
}

/// Where a ray meets a splat's plane, measured as the splat's shape has it.
PlaneHit meet_splat(uint splat, uvec4 words, Ray ray) {
  PlaneHit hit = splat_plane_hit(words, ray.origin, ray.origin_low, ray.dir);
  if (ELLIPSES) hit = ellipse_hit(clip_word(splat), words, hit);
  return hit;
}

/// Whether a meeting is on the part of the splat's plane that its clip lines leave.
bool clip_keeps(uint clip, uvec4 words, PlaneHit hit) {
  bool single = ELLIPSES && is_ellipse(clip);
  return line_keeps(clip, words, hit) && (single || line_keeps(clip >> 16u, words, hit));
}

/// Whether a meeting with a disc's plane is a hit on the disc that counts in an interval [t_in, t_out) of the ray.
bool hit_accepted(uvec4 words, uint splat, PlaneHit hit, Ray ray, float t_in, float t_out) {
  bool on_disc =
      !df_less(vec2(splat_radius_squared(words), 0.0f), hit.rho_squared) && hit.rho_squared.x >= 0.0f;
  bool in_range = hit.t.x >= t_in && hit.t.x < t_out && hit.t.x > ray.t_min && hit.t.x < ray.t_max;
  // Without paths there is no chance to be had: what is see-through is cut out.
  // Most are rejected by the first two: the rest is skipped where that is so for a whole warp.
  bool accepted = on_disc && in_range;
  if (accepted) {
    if (REGION) accepted = region_keeps(ray, hit.t.x);
    if (CLIPS) {
      uint clip = clip_word(splat);
      if (clip != CLIP_NONE) accepted = accepted && clip_keeps(clip, words, hit);
    }
#ifndef LIT
    if (OPACITY) accepted = accepted && opacity_at(splat) >= 0.5f;
#endif
    accepted = accepted && hit_allowed(words, hit, ray);
  }
  return accepted;
}

/// Makes a hit the first one, if it comes before that.
void take_first(uint splat, uvec4 words, PlaneHit hit, INOUT(First) first) {
  float share = 0.0f;
  bool before = df_less(hit.t, first.t);
  bool beside = hit.t.x == first.t.x && hit.t.y == first.t.y;
  if (BLEND == BLEND_PAPER || BLEND == BLEND_LEAF) {
    share = hit.rho_squared.x / splat_radius_squared(words);
    before = share < first.share;
    beside = share == first.share;
  }
  if (before || (beside && words_less(words, first.words))) {
    first.t = hit.t;
    first.share = share;
    first.from_center = hit.from_center;
    first.front = hit.facing < 0.0f;
    first.words = words;
    first.splat = splat;
  }
}

#endif
