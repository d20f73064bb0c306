// Path tracing (Kajiya 1986, "The Rendering Equation"): at each of a path's vertices light is looked for and one direction
// followed, both joined by multiple importance sampling (Veach 1997, "Robust Monte Carlo Methods for Light Transport Simulation",
// ch. 9). The blended normal is the geometric one too, but for normal maps: discs stand in for the smooth surface that it
// estimates, not the other way round. Needs material_at(object), albedo_at(index), absorption_at(bit) and the constants LOOK,
// OUTPUT, LIGHTS, SHADOWS, EMISSION, GLASS, STRAIGHT, PANES and those of bsdf.glsl.
#ifndef SPLATRAY_TRANSPORT_GLSL
#define SPLATRAY_TRANSPORT_GLSL
#include "lang/sobol.glsl"
#include "light/bsdf.glsl"
#include "light/light_samples.glsl"
#include "light/material.glsl"
#include "light/pane.glsl"
#include "light/path.glsl"
#include "trace/blend.glsl"
#include "trace/shadow.glsl"

/// From this bounce on paths end by chance, those with less than a half of their light, as often as it is less.
const uint ROULETTE_BOUNCE = 1u;
/// The same for mirrors' and clear glass's one direction: what is seen by them has no noise of its own.
const uint ROULETTE_BOUNCE_DELTA = 3u;
const float ROULETTE_LEFT = 0.5f;
const float CLAY_ALBEDO = 0.8f;
/// LOOK_SCAN: of a colour's brightness, what comes from the sky at points that nothing is near. Level ground and walls that face the
/// viewer get the rest from the key light, whose cosine is 0.71 there and 0.58: its irradiance is 1 (app/library/shot/lights.cpp).
const float SCAN_SKY = 0.795f;

/// What scatters light at a hit, seen at this cosine. `eta` as Bsdf has it.
Bsdf bsdf_at(Hit hit, Material material, float eta, float cosine) {
  Bsdf bsdf = bsdf_of(material, hit.color, eta);
  if (!hit.front) bsdf.tint = vec3(1.0f);  // once, in and out together: a pane's two sides are one pane
  if (LOOK == LOOK_SCAN) bsdf.base = hit.color;
  if (LOOK == LOOK_CLAY) bsdf.base = vec3(CLAY_ALBEDO);
  if (LOOK == LOOK_AO) bsdf.base = vec3(1.0f);
  bsdf_seen(bsdf, cosine);
  return bsdf;
}

/// Light that a path brings back which has met `bounces` surfaces behind the first: not more than frame.clamp, which loses light
/// but takes out the few bright dots of paths that are seldom found.
vec3 clamped(vec3 light, uint bounces) {
  float most = max(light.x, max(light.y, light.z));
  return frame.clamp > 0.0f && bounces > 0u && most > frame.clamp ? light * (frame.clamp / most) : light;
}

/// Whether a direction is on one side of a normal map's normal and on the other of the surface, so that no light takes it.
bool through_plane(Hit hit, vec3 dir, float cosine) { return TEXTURE_NORMAL && dot(dir, hit.plane) * cosine <= 0.0f; }

/// A ray that is worth tracing for the light it brings where nothing is in its way.
struct EmissionSample {
  Ray ray;      ///< ends before it starts where it brings none
  vec3 light;   ///< sent on to the eye from a hit; of splats that send out light: where they send out 1
  float share;  ///< of it that counts where paths find it, too
  uvec4 splat;  ///< words of one, which the ray looks for; else NO_SPLAT
  float pdf;    ///< how often the path would go on that way, per solid angle
};

EmissionSample no_emission_sample() {
  EmissionSample probe;
  probe.ray = secondary_ray(vec3(0.0f), vec3(0.0f), 0u, vec3(0.0f), NO_OBJECT);
  probe.light = vec3(0.0f);
  probe.share = 1.0f;
  probe.splat = NO_SPLAT;
  probe.pdf = 0.0f;
  return probe;
}

/// Whether some light is met by rays alone: a constant environment, and splats that send out light and are not looked for.
bool light_met_alone() {
  bool sky = !SKY && max(frame.environment.x, max(frame.environment.y, frame.environment.z)) > 0.0f;
  return sky || (EMISSION && frame.emitters == 0u);
}

/// Whether a path's vertex takes all direct light by looking for it: the last one, behind which no ray follows that would meet
/// some of it.
bool takes_all_light(uint bounce) { return bounce >= frame.max_bounces && !light_met_alone(); }

/// Towards a light that was chosen, whose light the surface sends on to the eye by `value`, a direction that the path would take with
/// probability `pdf`. `inside`: the dielectrics there. `all`: nothing else finds the light.
EmissionSample towards_light(Hit hit, LightSample chosen, vec3 value, float pdf, uint inside, bool all) {
  EmissionSample probe;
  probe.splat = chosen.splat;
  bool emitter = EMISSION && probe.splat != NO_SPLAT;
  probe.pdf = all ? 0.0f : pdf;
  probe.share = LOOK == LOOK_SCAN || emitter || all ? 1.0f : mis_weight(chosen.pdf, probe.pdf);
  probe.light = value * chosen.radiance;
  probe.ray = ray_from_hit(hit, chosen.dir, inside);
  probe.ray.t_max = LOOK == LOOK_SCAN ? min(chosen.distance, frame.reach) : chosen.distance;
  if (SIZES && SHADOWS && LOOK != LOOK_SCAN && !emitter && light_hides(probe.ray, chosen.light)) probe.light = vec3(0.0f);
  if (max(probe.light.x, max(probe.light.y, probe.light.z)) <= 0.0f) probe.ray.t_max = -1.0f;
  return probe;
}

/// Towards one of the lights, splats that send out light, or the environment. `all` as above.
EmissionSample sample_emitter(Hit hit, Bsdf bsdf, Basis basis, vec3 to_eye, vec3 random, uint inside, bool all) {
  LightSample chosen = light_sample(receiver_at(hit.position, hit.plane, hit.object), random);
  vec3 to_light = vec3(dot(chosen.dir, basis.u), dot(chosen.dir, basis.v), dot(chosen.dir, hit.normal));
  float pdf = 0.0f;
  vec3 value = bsdf_value(bsdf, to_eye, to_light, pdf);
  if (through_plane(hit, chosen.dir, to_light.z)) value = vec3(0.0f);
  uint object_bit = 0u;
  if (GLASS && to_light.z < 0.0f) object_bit = 1u << material_at(hit.object).mask_bit;
  return towards_light(hit, chosen, value, pdf, inside ^ object_bit, all);
}

/// What a path's ray sees first, and whether the splat with these words is a member of it. A sheet that is see-through is there
/// as often as its opacity says, by a hash of the ray and of the sheet's first splat (stochastic transparency: Enderton et al.
/// 2010), which no order of splats changes, and of the sheets before: at a crease each of two sheets may be met again from the
/// other, which would not end if a sheet were always passed by the rays that have passed it once. `of_ray` distinguishes rays.
Hit trace_seen(Ray ray, uvec4 target, uint of_ray, INOUT(Tally) tally) {
  float passed = 0.0f;
  bool passes = false;
  Hit hit;
  do {
    hit = trace_watching(ray, frame.kappa, target, tally);
    passes = false;
    if (OPACITY) {
      // The mean of what is all opaque may be a rounding below 1.
      float opacity = hit.factors.layer.w > 0.999999f ? 2.0f : hit.factors.layer.w;
      float chance = LOOK == LOOK_SEEN ? 0.5f : unit_float(hash_uint(of_ray ^ hash_words(hit.first)));
      passes = hit.found && chance >= opacity;
      of_ray += 0x9e3779b9u;
      // Never back: from where a sheet's blend lies before its first splat, the sheets before would be met again and again.
      float ahead = max(hit.t, hit.t_first);
      vec3 origin = ray.origin + ray.dir * ahead;
      bool bounded = ray.bounded;
      ray = ray_from_hit(hit, ray.dir, ray.inside);
      ray.bounded = bounded;
      ray.origin = origin;
      hit.t += passed;
      hit.t_first += passed;
      passed += ahead;
    }
  } while (passes);
  return hit;
}

/// A number that distinguishes the rays of a picture, those for light from those of paths.
uint hash_ray(Path path, bool to_light, uint pixel, uint sample_index) {
  uint bounce = 2u * path.bounce + (to_light ? 1u : 0u);
  return hash_uint(pixel ^ hash_uint(sample_index ^ hash_uint(bounce + 0x9e3779b9u * frame.seed)));
}

/// The part of the light that splats send out and a path meets which counts beside what was looked for. `pdf` of its direction, >
/// 0.
float emitter_share(float pdf, Ray ray, vec3 sent) {
  float radiance = mean_of(sent);
  if (frame.emitters == 0u || radiance <= 0.0f) return 1.0f;
  return mis_weight(pdf, emitters_pdf(receiver_left(ray), ray, radiance) * (1.0f - frame.sky_share));
}

/// How much light that runs this far is left of it.
vec3 medium_left(uint inside, float t) {
  if (!GLASS || inside == 0u) return vec3(1.0f);
  return exp(-(absorption_at(uint(findMSB(inside))) * t));
}

/// Light of a sampled emissive splat, times its share of the cluster hit and the MIS weight of having sampled it.
vec3 emitter_light(EmissionSample probe, Hit hit) {
  Ray ray = probe.ray;
  ray.t_max = hit.t;
  bool seen = hit.found && hit.target_fraction > 0.0f;
  if (SIZES && seen && light_hides(ray, NO_LIGHT)) seen = false;
  if (!seen) return vec3(0.0f);
  vec3 sent = textured(material_at(hit.object), hit.factors).emission;
  float share = hit.target_fraction * (1.0f - emitter_share(max(probe.pdf, 1e-30f), ray, sent));
  return probe.light * sent * medium_left(ray.inside, hit.t) * share;
}

/// Towards a white sky, whose light is weighted by cosine.
EmissionSample sample_sky_light(Hit hit, Bsdf bsdf, Basis basis, vec2 random, uint inside) {
  vec2 at = disc_sample(random);
  float height = sqrt(max(1.0f - dot(at, at), 0.0f));
  EmissionSample probe = no_emission_sample();
  probe.light = bsdf.base * (LOOK == LOOK_SCAN ? SCAN_SKY : 1.0f);
  probe.ray = ray_from_hit(hit, basis.u * at.x + basis.v * at.y + hit.normal * height, inside);
  probe.ray.t_max = frame.reach;
  return probe;
}

/// Adds the light that a ray brings where nothing is in its way, which is looked at where `hides`.
void take_light(INOUT(Path) path, EmissionSample probe, bool hides, INOUT(Tally) tally) {
  if (hides) {
    Passing passing = trace_shadow(probe.ray, tally);
    if ((TINTED || PANES) && passing.glass != 0u) probe.share = 1.0f;
    probe.light *= passing.light;
    path.shadow += probe.ray.t_max >= 0.0f ? 1u : 0u;
  }
  path.radiance += clamped(path.throughput * (probe.light * probe.share), path.bounce);
}

/// The light found from a hit by LOOK's rays: to a light, to the sky or both, one after the other, so that programs hold one walk
/// for them. For the light of a splat, which a ray must hit as paths do, `emitter` is left.
void sample_lights(INOUT(Path) path, Hit hit, Bsdf bsdf, Basis basis, vec3 to_eye, vec4 random, uint pixel, uint sample_index,
                INOUT(EmissionSample) emitter, INOUT(Tally) tally) {
  bool sky = LOOK == LOOK_AO || LOOK == LOOK_SCAN;
  bool to_lights = LIGHTS || SKY || EMISSION;
  do {
    EmissionSample probe;
    if (sky) {
      vec4 random_sky = sobol_sample(pixel, sample_index, 2u, frame.seed);
      probe = sample_sky_light(hit, bsdf, basis, vec2(random_sky), path.ray.inside);
    } else {
      probe = sample_emitter(hit, bsdf, basis, to_eye, vec3(random), path.ray.inside, takes_all_light(path.bounce));
      to_lights = false;
    }
    if (EMISSION && probe.splat != NO_SPLAT && probe.ray.t_max >= 0.0f) {
      emitter = probe;
      emitter.light *= path.throughput;
      path.shadow += 1u;
      probe.ray.t_max = -1.0f;
      probe.light = vec3(0.0f);
    }
    take_light(path, probe, SHADOWS || sky, tally);
    sky = false;
  } while (to_lights);
}

/// Ends a path at the bounce limit where it is `cut`.
void cut_path(INOUT(Path) path, vec3 throughput, bool cut) {
  path.cut = cut ? 1u : path.cut;
  path.energy_lost = cut ? (throughput.x + throughput.y + throughput.z) / 3.0f : path.energy_lost;
  path.alive = path.alive && !cut;
}

/// Has the path go on from a hit in a direction of the world that was chosen; `random`: whether it does. `matte`: the surface sends
/// light back that no mirror does.
void go_on(INOUT(Path) path, Hit hit, BsdfSample chosen, vec3 dir, float random, bool matte) {
  vec3 throughput = path.throughput * chosen.weight;
  float most = max(throughput.x, max(throughput.y, throughput.z));
  path.alive = most > 0.0f;
  if (COUNTERS && !path.alive && (chosen.event & BSDF_REFLECTED) != 0u && matte) {
    path.below = 1u;
    path.energy_below = (path.throughput.x + path.throughput.y + path.throughput.z) / 3.0f;
  }
  // Mirrors and glass show light that only rays meet: behind the last vertex they still see where it comes from.
  bool cut = path.alive && takes_all_light(path.bounce) && (chosen.event & BSDF_DELTA) == 0u;
  cut_path(path, throughput, cut);
  if (path.bounce >= ((chosen.event & BSDF_DELTA) != 0u ? ROULETTE_BOUNCE_DELTA : ROULETTE_BOUNCE)) {
    float survival = min(most / ROULETTE_LEFT, 1.0f);
    path.alive = path.alive && random < survival;
    throughput /= max(survival, 1e-20f);
  }
  bool transmitted = (chosen.event & BSDF_TRANSMITTED) != 0u;
  uint inside = path.ray.inside;
  if (GLASS && transmitted) inside ^= 1u << material_at(hit.object).mask_bit;
  bool straight = STRAIGHT;
  if (PANES) straight = straight || is_pane(material_at(hit.object));
  bool found_straight = straight && transmitted && path.pdf != 0.0f;
  path.pdf = found_straight ? -1.0f : ((chosen.event & BSDF_DELTA) != 0u ? 0.0f : chosen.pdf);
  path.ray = ray_from_hit(hit, dir * inversesqrt(dot(dir, dir)), inside);
  path.throughput = throughput;
  path.reflected += path.alive && !transmitted ? 1u : 0u;
  path.refracted += path.alive && transmitted ? 1u : 0u;
  path.bounce += 1u;
}

/// Has the path go on from a hit, or end there.
void scatter(INOUT(Path) path, Hit hit, Bsdf bsdf, Basis basis, vec3 to_eye, vec4 random) {
  BsdfSample chosen = bsdf_direction(bsdf, to_eye, vec3(random));
  bsdf_weigh(bsdf, to_eye, chosen);
  vec3 dir = basis.u * chosen.dir.x + basis.v * chosen.dir.y + hit.normal * chosen.dir.z;
  if (through_plane(hit, dir, chosen.dir.z)) chosen.weight = vec3(0.0f);
  go_on(path, hit, chosen, dir, random.w, max(bsdf.base.x, max(bsdf.base.y, bsdf.base.z)) > 0.0f);
}

/// Ends a path in light from all around; `light_pdf`: how often that was looked for there.
void end_in_light(INOUT(Path) path, vec3 radiance, float light_pdf) {
  float share = 1.0f;
  if (SKY) share = mis_weight(path.pdf, light_pdf);
  path.radiance += clamped(path.throughput * radiance * share, max(path.bounce, 1u) - 1u);
  if (OUTPUT == OUTPUT_BASE && path.bounce == 0u) path.base = min(path.radiance, vec3(1.0f));
  path.leaked = path.ray.inside != 0u ? 1u : 0u;
  path.alive = false;
}

/// Whether a ray that meets nothing shows a background that lights nothing.
bool sees_background(Path path) { return path.bounce == 0u && frame.background.x >= 0.0f; }

/// What a path finds where it meets nothing.
void meet_environment(INOUT(Path) path) {
  vec3 radiance = sees_background(path) ? frame.background : frame.environment;
  float light_pdf = 0.0f;
  if (ENVIRONMENT && !sees_background(path)) {
    vec3 own = to_environment(path.ray.dir);
    vec2 at = environment_position(own);
    radiance = environment_at(at);
    if (SKY && path.pdf > 0.0f) light_pdf = sky_pdf(own, at) * frame.sky_share;
  }
  end_in_light(path, radiance, light_pdf);
}

/// LOOK_SEEN: half of the colour is as bright wherever it faces.
void show_seen(INOUT(Path) path, Hit hit, Bsdf bsdf, vec3 to_eye, uint pixel) {
  float eye_distance = 0.0f;
  center_ray(uvec2(pixel % frame.width, pixel / frame.width), eye_distance);
  path.radiance = bsdf.base * (0.5f + 0.5f * to_eye.z);
  path.coverage = (hit.t + eye_distance) * frame.root_unit_world;
}

/// What a path finds at a hit, and whether and how it goes on. `emitter` as sample_lights has it.
void shade_hit(INOUT(Path) path, Hit hit, uint pixel, uint sample_index, INOUT(EmissionSample) emitter, INOUT(Tally) tally) {
  path.coverage = path.bounce == 0u ? 1.0f : path.coverage;
  Material material = textured(material_at(hit.object), hit.factors);
  float eta = 1.0f;
  if (GLASS) {
    if ((material.flags & MATERIAL_DIELECTRIC) != 0u) eta = eta_at(hit, path.ray.inside, material);
    path.throughput *= medium_left(path.ray.inside, hit.t);
  }
  if (EMISSION) {
    vec3 sent = material.emission;
    float share = path.pdf > 0.0f ? emitter_share(path.pdf, path.ray, sent) : 1.0f;
    path.radiance += clamped(path.throughput * sent * share, max(path.bounce, 1u) - 1u);
  }
  // Behind the last vertex a ray finds what sends out light, and no more.
  if (path.bounce > frame.max_bounces) {
    cut_path(path, path.throughput, true);
    return;
  }
  Basis basis = basis_of(hit.normal);
  vec3 to_eye = vec3(-dot(path.ray.dir, basis.u), -dot(path.ray.dir, basis.v), max(-dot(path.ray.dir, hit.normal), 1e-6f));
  Bsdf bsdf = bsdf_at(hit, material, eta, to_eye.z);
  if (OUTPUT == OUTPUT_BASE && path.bounce == 0u) path.base = bsdf.base;
  vec4 random = sobol_sample(pixel, sample_index, 1u + 2u * path.bounce, frame.seed);
  if (LIGHTS || SKY || EMISSION || LOOK == LOOK_AO || LOOK == LOOK_SCAN)
    sample_lights(path, hit, bsdf, basis, to_eye, random, pixel, sample_index, emitter, tally);
  if (LOOK == LOOK_BASE) path.radiance = bsdf.base;
  if (LOOK == LOOK_SEEN) show_seen(path, hit, bsdf, to_eye, pixel);
  if (LOOK == LOOK_AO || LOOK == LOOK_SCAN || LOOK == LOOK_BASE || LOOK == LOOK_SEEN) {
    path.alive = false;
  } else {
    scatter(path, hit, bsdf, basis, to_eye, sobol_sample(pixel, sample_index, 2u + 2u * path.bounce, frame.seed));
  }
}

/// Adds the light of lights with a size that a path's ray meets before the hit. Returns whether one hides that, and ends the path.
bool meet_lights(INOUT(Path) path, Hit hit) {
  float t = hit.t;
  path.radiance += clamped(path.throughput * met_light(path.ray, path.pdf, t), max(path.bounce, 1u) - 1u);
  bool hidden = t < hit.t;
  path.coverage = hidden && path.bounce == 0u ? 1.0f : path.coverage;
  path.alive = !hidden;
  return hidden;
}

/// What a path's ray finds.
void meet(INOUT(Path) path, Hit hit, uint pixel, uint sample_index, INOUT(EmissionSample) emitter, INOUT(Tally) tally) {
  bool light_first = false;
  if (SIZES && LOOK != LOOK_SCAN) light_first = meet_lights(path, hit);
  if (!light_first) {
    if (hit.found) {
      shade_hit(path, hit, pixel, sample_index, emitter, tally);
    } else {
      meet_environment(path);
    }
  }
}

/// Follows a path: to its end or, in a stage, for one ray. `pixel` numbers the pixel in the whole picture. Rays that look for the
/// light of splats take their turn between those of the path, so that programs hold one walk for both.
void follow_path(INOUT(Path) path, uint pixel, uint sample_index, INOUT(Tally) tally) {
  EmissionSample emitter = no_emission_sample();
  bool looks = false;
  do {
    Ray ray = path.ray;
    if (EMISSION && looks) ray = emitter.ray;
    Hit hit = trace_seen(ray, emitter.splat, hash_ray(path, looks, pixel, sample_index), tally);
    if (EMISSION && looks) {
      path.radiance += clamped(emitter_light(emitter, hit), max(path.bounce, 1u) - 1u);
      emitter.splat = NO_SPLAT;
    } else {
      meet(path, hit, pixel, sample_index, emitter, tally);
    }
    looks = EMISSION && emitter.splat != NO_SPLAT;
  } while (looks || path.alive);
}

#endif
