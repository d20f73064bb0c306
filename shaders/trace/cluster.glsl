// The cluster of the first splat that a ray hits: the splats of the same object with like normals, met from the same side, in a
// window of depth behind it, which are blended. Sums are integers, so the blend does not depend on the order in which splats are
// found. Needs, beside accept.glsl: color_at(splat), field_word(splat), and the constants KERNEL, COLORS, FIELDS, LEANS, WATCHES.
#ifndef SPLATRAY_CLUSTER_GLSL
#define SPLATRAY_CLUSTER_GLSL
#include "trace/accept.glsl"

const float WINDOW_SLACK = 1.0f;            ///< lattice units; float32's step of t: no leaf with a member is left out

/// Whether the first hit is to be blended with others.
bool has_cluster() { return BLEND != BLEND_NEAREST && BLEND != BLEND_COUNT && BLEND != BLEND_ANY; }

/// Integer sums over a cluster.
struct Cluster {
  int weight;
  ivec3 normal;
  int depth;
  ivec3 color;
  uint members;
  uint target_members;  ///< members that are the target splat
#ifdef LIT
  FactorSums factors;
  ivec3 tilt;
#endif
};

/// Words of no splat.
const uvec4 NO_SPLAT = uvec4(0u, 0u, 0u, 0u);

Cluster empty_cluster() {
  Cluster cluster;
  cluster.weight = 0;
  cluster.normal = ivec3(0);
  cluster.depth = 0;
  cluster.color = ivec3(0);
  cluster.members = 0u;
  cluster.target_members = 0u;
#ifdef LIT
  cluster.factors = no_factor_sums();
  cluster.tilt = ivec3(0);
#endif
  return cluster;
}

/// Unit normal turned against the ray.
vec3 normal_against(uvec4 words, vec3 dir) {
  vec3 normal = unit_normal(words);
  return dot(normal, dir) > 0.0f ? -normal : normal;
}

/// Depth of the cluster's window behind (and, for BLEND_PAPER, before) the first hit.
float window_depth(First first, vec3 dir, float kappa) {
  float radius = sqrt(splat_radius_squared(first.words));
  if (BLEND == BLEND_PAPER || BLEND == BLEND_LEAF) return kappa * radius;
  return kappa * radius / max(abs(dot(normal_against(first.words, dir), dir)), MIN_COSINE);
}

float blend_kernel(float u_squared) {
  if (KERNEL == KERNEL_GAUSSIAN) return exp(-2.0f * u_squared);
  float fall = max(1.0f - u_squared, 0.0f);
  return fall * fall;
}

/// Weight along the window: 1 to the middle, then smoothly to 0 at the end (BLEND_WINDOW), or 1 (the paper's
/// interval).
float window_fall(float share) {
  if (BLEND == BLEND_PAPER || BLEND == BLEND_LEAF) return 1.0f;
  float x = clamp(2.0f - 2.0f * share, 0.0f, 1.0f);
  return x * x * (3.0f - 2.0f * x);
}

/// The surface where a ray meets the plane of a disc.
struct Facet {
  vec3 normal;    ///< unit, turned against the ray
  float behind;   ///< how much farther along the ray than the plane
};

/// The disc itself, or what its normal field makes of it. A field's normal turns at most until it is square to the ray.
Facet facet_at(uvec4 words, uint splat, vec3 from_center, float inverse_radius, vec3 dir) {
  vec3 normal = unit_normal(words);
  float cosine = dot(normal, dir);
  Facet facet;
  facet.normal = cosine > 0.0f ? -normal : normal;
  facet.behind = 0.0f;
  if (FIELDS) {
    FieldPoint point = field_point(field_word(splat), LEANS, normal, from_center, inverse_radius);
    vec3 turned = cosine > 0.0f ? -point.normal : point.normal;
    turned -= dir * max(dot(turned, dir), 0.0f);
    facet.normal = turned * inversesqrt(dot(turned, turned));
    facet.behind = point.height / (cosine > 0.0f ? max(cosine, MIN_COSINE) : min(cosine, -MIN_COSINE));
  }
  return facet;
}

/// What of a first hit the splats of its cluster are compared with.
struct Window {
  vec3 normal;  ///< of the first splat, as it is stored
  bool back;    ///< its back is hit
  uint object;
  vec2 t;       ///< of the first hit
  float inverse_depth;
};

Window window_of(First first, Ray ray, float depth) {
  Window window;
  window.normal = unit_normal(first.words);
  window.back = dot(window.normal, ray.dir) > 0.0f;
  window.object = splat_object(first.words);
  window.t = first.t;
  window.inverse_depth = 1.0f / depth;
  return window;
}

/// Where in its window a splat is met: 0 at the first hit, 1 at the end behind it.
float window_share(PlaneHit hit, Window window) { return df_add(hit.t, -window.t).x * window.inverse_depth; }

/// Whether a splat that is hit belongs to the first splat's cluster: the other side of a plate thinner than the window does not.
bool is_member(uvec4 words, PlaneHit hit, Ray ray, Window window, Cluster cluster) {
  float share = window_share(hit, window);
  vec3 normal = unit_normal(words);
  bool same_side = (dot(normal, ray.dir) > 0.0f) == window.back;
  return share <= 1.0f && share >= -1.0f && splat_object(words) == window.object && same_side &&
         dot(normal, window.normal) > 0.5f && cluster.members < MEMBERS_MOST;
}

/// Adds a member, where it is met, to the cluster.
void add_splat(uint splat, uvec4 words, PlaneHit hit, Ray ray, Window window, uvec4 target, INOUT(Cluster) cluster) {
  float behind = df_add(hit.t, -window.t).x;
  float inverse_radius = inversesqrt(splat_radius_squared(words));
  float u_squared = hit.rho_squared.x * (inverse_radius * inverse_radius);
  Facet facet = facet_at(words, splat, hit.from_center, inverse_radius, ray.dir);
  float weight = max(blend_kernel(u_squared) * window_fall(behind * window.inverse_depth), WEIGHT_LEAST) * WEIGHT_UNIT;
  float share = clamp((behind + facet.behind) * window.inverse_depth, -1.0f, 1.0f);
  cluster.weight += int(weight + 0.5f);
  cluster.normal += ivec3(floor(facet.normal * weight + vec3(0.5f)));
  cluster.depth += int(floor(weight * share + 0.5f));
  if (COLORS) cluster.color += ivec3(color_at(splat) * weight + vec3(0.5f));
  if (WATCHES) cluster.target_members += words == target ? 1u : 0u;
#ifdef LIT
  add_factors(cluster.factors, factors_at(splat), weight);
  if (TEXTURE_NORMAL)
    cluster.tilt += ivec3(floor(tilt_at(splat, normal_against(words, ray.dir)) * weight + vec3(0.5f)));
#endif
  cluster.members += 1u;
}

/// The nearest hit and its cluster (the first splat alone where it grazes the ray so much that float32 finds
/// no member). `shift` is what clip_to_root took from t.
Hit finish_hit(Ray ray, First first, Cluster cluster, float depth, float shift, uvec4 target) {
  Hit hit;
  hit.found = is_found(first);
  hit.first = first.words;
  hit.object = hit.found ? splat_object(first.words) : NO_OBJECT;
  hit.front = first.front;
  hit.members = cluster.members;
  hit.target_fraction = WATCHES && hit.found && first.words == target ? 1.0f : 0.0f;
  vec2 t = first.t;
  vec3 normal = normal_against(first.words, ray.dir);
  hit.color = vec3(1.0f);
#ifdef LIT
  hit.factors = no_factors();
  vec3 tilt = vec3(0.0f);
#endif
  if (has_cluster() && cluster.weight > 0) {
    float inverse = 1.0f / float(cluster.weight);
    t = df_add(t, vec2(depth * (float(cluster.depth) * inverse), 0.0f));
    normal = vec3(cluster.normal);
    normal *= inversesqrt(dot(normal, normal));
    if (WATCHES) hit.target_fraction = float(cluster.target_members) / float(cluster.members);
    if (COLORS) hit.color = vec3(cluster.color) * inverse;
#ifdef LIT
    hit.factors = mean_factors(cluster.factors, inverse);
    tilt = vec3(cluster.tilt) * inverse;
#endif
  } else if (hit.found) {
    if (COLORS) hit.color = color_at(first.splat);
#ifdef LIT
    hit.factors = factors_at(first.splat);
    if (TEXTURE_NORMAL) tilt = tilt_at(first.splat, normal);
#endif
    float inverse_radius = inversesqrt(splat_radius_squared(first.words));
    Facet facet = facet_at(first.words, first.splat, first.from_center, inverse_radius, ray.dir);
    normal = facet.normal;
    t = df_add(t, vec2(facet.behind, 0.0f));
  }
  hit.position = ray.origin + ray.dir * t.x;
  hit.normal = normal;
#ifdef LIT
  hit.plane = normal;
  if (TEXTURE_NORMAL && hit.found) hit.normal = tilted(normal, tilt, ray.dir);
#endif
  hit.t = hit.found ? df_add(t, vec2(shift, 0.0f)).x : INFINITY_F;
  hit.t_first = hit.found ? df_add(first.t, vec2(shift, 0.0f)).x : INFINITY_F;
  return hit;
}

/// No splat of the cluster of BLEND_WINDOW is met behind it.
float window_end(First first, float depth) { return first.t.x + depth * 1.0001f + WINDOW_SLACK; }

#endif
