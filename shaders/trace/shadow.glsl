// How much light passes along a ray. Needs what blend.glsl needs, and the constant TINTED: dielectrics tint light, else they are
// as opaque as anything, but for panes. With LIT also pane_passes (light/pane.glsl), with OPACITY or PANES frame.kappa.
#ifndef SPLATRAY_SHADOW_GLSL
#define SPLATRAY_SHADOW_GLSL
#include "trace/blend.glsl"

#ifdef LIT
/// A sheet that a shadow ray meets: splats of one object in a window of depth, what they hide blended as colours are.
struct Sheet {
  uint object;
  bool back;    ///< PANES: its back is met
  float t;      ///< of the splat found first
  float depth;  ///< of the window before and behind it
  int weight;
  ivec3 hidden;
};

Sheet no_sheet() {
  Sheet sheet;
  sheet.object = NO_OBJECT;
  sheet.back = false;
  sheet.t = 0.0f;
  sheet.depth = 0.0f;
  sheet.weight = 0;
  sheet.hidden = ivec3(0);
  return sheet;
}

/// What a sheet lets through; one without splats everything, one whose splats are all opaque nothing.
vec3 sheet_passes(Sheet sheet) {
  return sheet.weight > 0 ? vec3(ivec3(sheet.weight) - sheet.hidden) / float(sheet.weight) : vec3(1.0f);
}

/// The two sheets that a shadow ray met last, as leaves list their splats in no order, and what those before let through.
struct Sheets {
  Sheet last;
  Sheet other;
  vec3 passed;
};

bool of_sheet(Sheet sheet, uint object, bool back, float t) {
  return sheet.object == object && sheet.back == back && abs(t - sheet.t) <= sheet.depth;
}

Sheets no_sheets() {
  Sheets sheets;
  sheets.last = no_sheet();
  sheets.other = no_sheet();
  sheets.passed = vec3(1.0f);
  return sheets;
}

/// What they let through in all.
vec3 sheets_pass(Sheets sheets) { return sheets.passed * sheet_passes(sheets.last) * sheet_passes(sheets.other); }

/// Adds a splat that the ray hits to its sheet. `pane`: what it lets through where it is not see-through.
void meet_sheet(INOUT(Sheets) sheets, uint splat, uvec4 words, PlaneHit hit, Ray ray, vec3 pane) {
  uint object = splat_object(words);
  bool back = PANES && hit.facing > 0.0f && pane != vec3(0.0f);
  if (!of_sheet(sheets.last, object, back, hit.t.x)) {
    Sheet older = sheets.last;
    bool again = of_sheet(sheets.other, object, back, hit.t.x);
    if (!again) sheets.passed *= sheet_passes(sheets.other);
    sheets.last = sheets.other;
    sheets.other = older;
    if (!again) {
      First first = no_first();
      first.words = words;
      sheets.last = no_sheet();
      sheets.last.object = object;
      sheets.last.back = back;
      sheets.last.t = hit.t.x;
      sheets.last.depth = window_depth(first, ray.dir, frame.kappa);
    }
  }
  float weight = max(blend_kernel(hit.rho_squared.x / splat_radius_squared(words)), WEIGHT_LEAST) * WEIGHT_UNIT;
  float opacity = 1.0f;
  if (OPACITY) opacity = opacity_at(splat);
  sheets.last.weight += int(weight + 0.5f);
  sheets.last.hidden += ivec3((vec3(1.0f) - pane) * (opacity * weight) + vec3(0.5f));
}

/// Whether a sheet hides all that lies behind t.
bool sheet_hides(Sheet sheet, float t) { return t > sheet.t + sheet.depth && sheet_passes(sheet) == vec3(0.0f); }

/// Whether sheets do, as they let nothing through.
bool sheets_hide(Sheets sheets, float t) {
  return sheets.passed == vec3(0.0f) || sheet_hides(sheets.last, t) || sheet_hides(sheets.other, t);
}
#endif

/// What of a shadow ray's light goes on, and what it depends on.
struct Passing {
  vec3 light;
  uint glass;  ///< bits of the dielectrics that it has passed: paths find no light of lights there
#ifdef LIT
  Sheets sheets;
#endif
};

Passing all_passing() {
  Passing passing;
  passing.light = vec3(1.0f);
  passing.glass = 0u;
#ifdef LIT
  passing.sheets = no_sheets();
#endif
  return passing;
}

/// Whether light passes a dielectric, as if that did not bend it; tints it by each object that it has not passed yet.
bool pass_glass(Material material, INOUT(Passing) passing) {
  bool glass = TINTED && (material.flags & MATERIAL_DIELECTRIC) != 0u;
  uint object_bit = 1u << material.mask_bit;
#ifdef LIT
  vec3 tint = material.base;
#else
  vec3 tint = material.phong.tint * material.phong.tint;
#endif
  passing.light = glass && (passing.glass & object_bit) == 0u ? passing.light * tint : passing.light;
  passing.glass |= glass ? object_bit : 0u;
  return glass;
}

#ifdef LIT
/// Whether some splat may let light through.
bool some_pass() { return TINTED || PANES || OPACITY; }

/// Has a shadow ray meet a splat that it hits. Returns whether nothing of its light goes on.
bool meet_passing(uint splat, uvec4 words, PlaneHit hit, Ray ray, INOUT(Passing) passing) {
  if (!some_pass()) return true;
  Material material = material_at(splat_object(words));
  bool pane = PANES && is_pane(material);
  bool ends = !pane && !pass_glass(material, passing);
  if (pane || (OPACITY && ends)) {
    passing.glass |= pane ? 1u << material.mask_bit : 0u;
    vec3 passes = vec3(0.0f);
    if (pane) passes = pane_passes(splat, words, material, hit, ray);
    meet_sheet(passing.sheets, splat, words, hit, ray, passes);
    ends = false;
  }
  return ends;
}
#else
bool some_pass() { return TINTED; }

bool meet_passing(uint, uvec4 words, PlaneHit, Ray, INOUT(Passing) passing) {
  return !some_pass() || !pass_glass(material_at(splat_object(words)), passing);
}
#endif

/// What of its light is left where the ray has met all; `ends`: nothing is.
void end_passing(bool ends, INOUT(Passing) passing) {
#ifdef LIT
  if (OPACITY || PANES) passing.light *= sheets_pass(passing.sheets);
#endif
  if (ends) passing.light = vec3(0.0f);
}

/// How much light passes along the ray: 0 behind anything opaque, the product of the tints of the dielectrics
/// met, as if they did not bend it (each object counts once), and of what see-through sheets and panes let through, else 1. The
/// ray starts inside the root; one that ends before it starts is not traced. HOST: engine/cpu/wide_shadow.h, by the wide tree.
#ifdef HOST
Passing trace_shadow(Ray ray, INOUT(Tally) tally);
#else
/// The same for a chunk of the current leaf.
bool meet_chunk(uint chunk, Walk walk, Ray ray, INOUT(Passing) passing, INOUT(Tally) tally) {
  bool ends = false;
  uint candidates = test_chunk(chunk, walk, ray, tally);
  while (!ends && candidates != 0u) {
    uint splat = splat_at(chunk + uint(findLSB(candidates)));
    candidates &= candidates - 1u;
    uvec4 words = splat_words(splat);
    PlaneHit hit = meet_splat(splat, words, ray);
    if (hit_accepted(words, splat, hit, ray, walk.t_in, walk.t_out)) ends = meet_passing(splat, words, hit, ray, passing);
  }
  return ends;
}

Passing trace_shadow(Ray ray, INOUT(Tally) tally) {
  ray.to_light = true;
  bool traced = ray.t_max >= 0.0f;
  float t_start = 0.0f;
  if (REGION) {
    clip_to_region(ray);
    traced = traced && ray.t_min < ray.t_max && ray.t_max >= 0.0f;
    t_start = region_start(ray, t_start);
  }
  Walk walk = walk_start(ray, t_start);
  Passing passing = all_passing();
  bool ends = false;
  while (traced && !ends && walk_on(walk, ray, ray.t_max, tally)) {
    for (uint chunk = walk.begin; !ends && chunk < walk.end; chunk += CHUNK)
      ends = meet_chunk(chunk, walk, ray, passing, tally);
#ifdef LIT
    if (OPACITY) ends = ends || sheets_hide(passing.sheets, walk.t_in);
#endif
  }
  end_passing(ends, passing);
  return passing;
}
#endif

#endif
