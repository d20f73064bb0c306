// How much light passes along a ray. Needs what blend.glsl needs, and the constant TINTED: dielectrics tint light, else they are
// as opaque as anything. With LIT and OPACITY also frame.kappa.
#ifndef SPLATRAY_SHADOW_GLSL
#define SPLATRAY_SHADOW_GLSL
#include "trace/blend.glsl"

#ifdef LIT
/// A sheet that a shadow ray meets: splats of one object in a window of depth, whose opacity is blended as colours are.
struct Sheet {
  uint object;
  float t;      ///< of the splat found first
  float depth;  ///< of the window before and behind it
  int weight;
  int opacity;
};

Sheet no_sheet() {
  Sheet sheet;
  sheet.object = NO_OBJECT;
  sheet.t = 0.0f;
  sheet.depth = 0.0f;
  sheet.weight = 0;
  sheet.opacity = 0;
  return sheet;
}

/// What a sheet lets through; one without splats everything, one whose splats are all opaque nothing.
float sheet_passes(Sheet sheet) {
  return sheet.weight > 0 ? float(sheet.weight - sheet.opacity) / float(sheet.weight) : 1.0f;
}

/// The two sheets that a shadow ray met last, as leaves list their splats in no order, and what those before let through.
struct Sheets {
  Sheet last;
  Sheet other;
  float passed;
};

bool of_sheet(Sheet sheet, uint object, float t) {
  return sheet.object == object && abs(t - sheet.t) <= sheet.depth;
}

void add_to_sheet(INOUT(Sheet) sheet, float opacity, float weight) {
  sheet.weight += int(weight + 0.5f);
  sheet.opacity += int(opacity * weight + 0.5f);
}

Sheets no_sheets() {
  Sheets sheets;
  sheets.last = no_sheet();
  sheets.other = no_sheet();
  sheets.passed = 1.0f;
  return sheets;
}

/// Adds a splat that the ray hits to its sheet.
void meet_sheet(INOUT(Sheets) sheets, uint splat, uvec4 words, PlaneHit hit, Ray ray) {
  uint object = splat_object(words);
  float weight = max(blend_kernel(hit.rho_squared.x / splat_radius_squared(words)), WEIGHT_LEAST) * WEIGHT_UNIT;
  if (!of_sheet(sheets.last, object, hit.t.x)) {
    Sheet older = sheets.last;
    bool again = of_sheet(sheets.other, object, hit.t.x);
    sheets.passed *= again ? 1.0f : sheet_passes(sheets.other);
    sheets.last = sheets.other;
    sheets.other = older;
    if (!again) {
      First first = no_first();
      first.words = words;
      sheets.last = no_sheet();
      sheets.last.object = object;
      sheets.last.t = hit.t.x;
      sheets.last.depth = window_depth(first, ray.dir, frame.kappa);
    }
  }
  add_to_sheet(sheets.last, opacity_at(splat), weight);
}

/// Whether sheets hide all that lies behind t, as they let nothing through.
bool sheets_hide(Sheets sheets, float t) {
  bool hidden = t > sheets.last.t + sheets.last.depth && sheet_passes(sheets.last) <= 0.0f;
  hidden = hidden || (t > sheets.other.t + sheets.other.depth && sheet_passes(sheets.other) <= 0.0f);
  return hidden || sheets.passed <= 0.0f;
}
#endif

/// Whether a splat that a shadow ray meets is of a dielectric that the ray passes; tints the light by each object that has not
/// a bit of `passed` yet.
bool pass_glass(uvec4 words, INOUT(vec3) light, INOUT(uint) passed) {
  Material material = material_at(splat_object(words));
  bool glass = TINTED && (material.flags & MATERIAL_DIELECTRIC) != 0u;
  uint object_bit = 1u << material.mask_bit;
#ifdef LIT
  vec3 tint = material.base;
#else
  vec3 tint = material.phong.tint * material.phong.tint;
#endif
  light = glass && (passed & object_bit) == 0u ? light * tint : light;
  passed |= glass ? object_bit : 0u;
  return glass;
}

/// How much light passes along the ray: 0 behind anything opaque, the product of the tints of the dielectrics
/// met, as if they did not bend it (each object counts once), else 1. The ray starts inside the root; one that ends before it
/// starts is not traced. HOST: engine/cpu/wide_shadow.h, by the wide tree.
#ifdef HOST
vec3 trace_shadow(Ray ray, INOUT(Tally) tally);
#elif defined(MASKED)
vec3 trace_shadow(Ray ray, INOUT(Tally) tally) {
  First first = no_first();
  bool traced = ray.t_max >= 0.0f;
  float t_start = 0.0f;
  if (REGION) {
    clip_to_region(ray);
    traced = traced && ray.t_min < ray.t_max && ray.t_max >= 0.0f;
    t_start = region_start(ray, t_start);
  }
  Walk walk = walk_start(ray, t_start, traced);
  vec3 light = vec3(1.0f);
  uint passed = 0u;
#ifdef LIT
  Sheets sheets = no_sheets();
#endif
  do {
    uint chunk = 0u;
    uint candidates = walk_candidates(walk, ray, ray.t_max, false, chunk, tally);
    uint accepted = accept_candidates(chunk, candidates, ray, walk, false, first);
    bool opaque = accepted != 0u;
#ifdef LIT
    if (OPACITY || TINTED) {
#else
    if (TINTED) {
#endif
      opaque = false;
      do {
        if (accepted != 0u) {
          uint bit = uint(findLSB(accepted));
          accepted &= accepted - 1u;
          uint splat = splat_at(chunk + bit);
          uvec4 words = splat_words(splat);
          bool glass = pass_glass(words, light, passed);
#ifdef LIT
          if (OPACITY && !glass) meet_sheet(sheets, splat, words, meet_splat(splat, words, ray), ray);
          opaque = opaque || (!OPACITY && !glass);
#else
          opaque = opaque || !glass;
#endif
        }
      } while (accepted != 0u);
#ifdef LIT
      if (OPACITY) opaque = sheets_hide(sheets, walk.t_in);
#endif
    }
    light = opaque ? vec3(0.0f) : light;
    walk.inside = walk.inside && !opaque;
  } while (walk.inside);
#ifdef LIT
  if (OPACITY) light *= sheets.passed * sheet_passes(sheets.last) * sheet_passes(sheets.other);
#endif
  return light;
}
#else
/// What of a shadow ray's light goes on, and what it depends on.
struct Passing {
  vec3 light;
  uint glass;  ///< bits of the dielectrics that have tinted it
#ifdef LIT
  Sheets sheets;
#endif
};

/// Has a shadow ray meet a splat that it hits. Returns whether nothing of its light goes on.
bool meet_passing(uint splat, uvec4 words, PlaneHit hit, Ray ray, INOUT(Passing) passing) {
  bool ends = true;
#ifdef LIT
  if (OPACITY || TINTED) {
    bool glass = pass_glass(words, passing.light, passing.glass);
    if (OPACITY && !glass) meet_sheet(passing.sheets, splat, words, hit, ray);
    ends = !OPACITY && !glass;
  }
#else
  if (TINTED) ends = !pass_glass(words, passing.light, passing.glass);
#endif
  return ends;
}

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

vec3 trace_shadow(Ray ray, INOUT(Tally) tally) {
  bool traced = ray.t_max >= 0.0f;
  float t_start = 0.0f;
  if (REGION) {
    clip_to_region(ray);
    traced = traced && ray.t_min < ray.t_max && ray.t_max >= 0.0f;
    t_start = region_start(ray, t_start);
  }
  Walk walk = walk_start(ray, t_start, traced);
  Passing passing;
  passing.light = vec3(1.0f);
  passing.glass = 0u;
#ifdef LIT
  passing.sheets = no_sheets();
#endif
  bool ends = false;
  while (traced && !ends && walk_on(walk, ray, ray.t_max, tally)) {
    for (uint chunk = walk.begin; !ends && chunk < walk.end; chunk += CHUNK)
      ends = meet_chunk(chunk, walk, ray, passing, tally);
#ifdef LIT
    if (OPACITY) ends = sheets_hide(passing.sheets, walk.t_in);
#endif
  }
  if (ends) passing.light = vec3(0.0f);
#ifdef LIT
  if (OPACITY) passing.light *= passing.sheets.passed * sheet_passes(passing.sheets.last) * sheet_passes(passing.sheets.other);
#endif
  return passing.light;
}
#endif

#endif
