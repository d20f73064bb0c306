// What a ray finds in the octree. Plain loops that end as soon as they can: a GPU's warp skips what none of its lanes needs. With
// loops that test at their ends, which suit llvmpipe, pictures take 1.7 times as long on an H100.
#ifndef SPLATRAY_OCTREE_GLSL
#define SPLATRAY_OCTREE_GLSL
#include "trace/cluster.glsl"

/// The splats of the current leaf that the ray may meet; false where there are none.
bool walk_list(INOUT(Walk) walk, Ray ray) {
  uint slab = slab_word(walk.filled);
  SlabCrossing crossing = walk_crossing(slab, walk, ray);
  bool some = !slab_missed(crossing);
  if (some) {
    walk.begin = begin_end_at(walk.filled);
    walk.end = begin_end_at(walk.filled + 1u);
    slab_halves(slab, crossing, walk.begin, walk.end);
    some = walk.begin < walk.end;
  }
  return some;
}

/// ADVANCE to the next leaf with splats that the ray may meet; false where there is none before t_end.
bool walk_on(INOUT(Walk) walk, Ray ray, float t_end, INOUT(Tally) tally) {
  bool some = false;
  while (!some && (walk.cell.x | walk.cell.y | walk.cell.z) < CELL_LIMIT && walk.t_out <= t_end && walk.leaves < MAX_LEAVES) {
    walk.t_in = walk.t_out;
    uint steps = walk_descend(walk, ray);
    walk.leaves += 1u;
    if (COUNTERS) tally.node_steps += steps;
    if (COUNTERS) tally.leaves += 1u;
    if (walk.filled != NO_LEAF) some = walk_list(walk, ray);
  }
  if (COUNTERS) tally.lost += !some && walk.leaves == MAX_LEAVES ? 1u : 0u;
  return some;
}

/// TEST: the candidates among the leaf's splats from `chunk` on, CHUNK at most: bit i is splat chunk + i.
uint test_chunk(uint chunk, Walk walk, Ray ray, INOUT(Tally) tally) {
  uint candidates = 0u;
  uint chunk_end = min(chunk + CHUNK, walk.end);
  for (uint place = chunk; place < chunk_end; place += 1u) {
    uvec4 words = splat_words(splat_at(place));
    if (splat_maybe_hit(words, ray.origin, ray.dir, walk.t_in, walk.t_out)) candidates |= 1u << (place - chunk);
  }
  if (COUNTERS) tally.tests += chunk_end - chunk;
  return candidates;
}

/// What a ray has found, while it walks.
struct Finding {
  First first;
  bool found;       ///< `first` is what decides the cluster
  Window window;    ///< of it
  float depth;
  Cluster cluster;
  uvec2 hits;       ///< of the current leaf's first two chunks, before `found`: bits as of candidates
};

Finding nothing_found() {
  Finding finding;
  finding.first = no_first();
  finding.found = false;
  finding.window.normal = vec3(0.0f);
  finding.window.back = false;
  finding.window.object = NO_OBJECT;
  finding.window.t = vec2(0.0f);
  finding.window.inverse_depth = 0.0f;
  finding.depth = 0.0f;
  finding.cluster = empty_cluster();
  finding.hits = uvec2(0u);
  return finding;
}

/// Takes the candidates of a chunk that are hits: for the first splat or, once that is found, into its cluster.
void take_hits(uint chunk, uint candidates, Ray ray, Walk walk, uvec4 target, INOUT(Finding) finding) {
  uint hits = 0u;
  while (candidates != 0u) {
    uint bit = uint(findLSB(candidates));
    candidates &= candidates - 1u;
    uint splat = splat_at(chunk + bit);
    uvec4 words = splat_words(splat);
    PlaneHit hit = meet_splat(splat, words, ray);
    if (hit_accepted(words, splat, hit, ray, walk.t_in, walk.t_out)) {
      if (!finding.found) {
        take_first(splat, words, hit, finding.first);
        hits |= 1u << bit;
        if (BLEND == BLEND_COUNT) finding.cluster.members += 1u;
      } else if (is_member(words, hit, ray, finding.window, finding.cluster)) {
        add_splat(splat, words, hit, ray, finding.window, target, finding.cluster);
      }
    }
  }
  finding.hits = uvec2(chunk == walk.begin ? hits : finding.hits.x, chunk == walk.begin + CHUNK ? hits : finding.hits.y);
}

/// Goes through the current leaf, and where that has the first hit once more, for its cluster. Returns whether it is a leaf behind
/// that of the first hit, and has candidates.
bool take_leaf(Walk walk, Ray ray, float kappa, uvec4 target, INOUT(Finding) finding, INOUT(Tally) tally) {
  uint passes = 1u;
  uint any = 0u;
  for (uint pass = 0u; pass < passes; pass += 1u) {
    for (uint chunk = walk.begin; chunk < walk.end; chunk += CHUNK) {
      if (BLEND == BLEND_ANY && is_found(finding.first)) break;
      uint candidates = chunk == walk.begin ? finding.hits.x : finding.hits.y;
      if (pass == 0u || walk.end - walk.begin > 2u * CHUNK) candidates = test_chunk(chunk, walk, ray, tally);
      any |= candidates;
      take_hits(chunk, candidates, ray, walk, target, finding);
    }
    if (has_cluster() && !finding.found && is_found(finding.first)) {
      finding.found = true;
      finding.depth = window_depth(finding.first, ray.dir, kappa);
      finding.window = window_of(finding.first, ray, finding.depth);
      passes = 2u;
    }
  }
  return finding.found && passes == 1u && any != 0u;
}

/// What the ray sees first, and whether a splat is a member of it, by the octree. The ray may start anywhere; one that ends
/// before it starts is not traced.
Hit trace_octree(Ray ray, float kappa, uvec4 target, INOUT(Tally) tally) {
  bool enters = true;
  float t_start = 0.0f;
  float shift = clip_to_root(ray, enters, t_start);
  if (WATCHES) enters = enters && ray.t_max >= 0.0f;
  Walk walk = walk_start(ray, t_start);
  Finding finding = nothing_found();
  float t_end = ray.t_max;
  while (enters && walk_on(walk, ray, t_end, tally)) {
    bool behind = take_leaf(walk, ray, kappa, target, finding, tally);
    if (BLEND == BLEND_WINDOW && finding.found) t_end = min(window_end(finding.first, finding.depth), ray.t_max);
    if (BLEND == BLEND_NEAREST || BLEND == BLEND_ANY) enters = !is_found(finding.first);
    if (BLEND == BLEND_LEAF) enters = !finding.found;
    if (BLEND == BLEND_PAPER) enters = !behind;
  }
  return finish_hit(ray, finding.first, finding.cluster, finding.depth, shift, target);
}

#endif
