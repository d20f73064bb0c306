// The octree's walk for llvmpipe, which masks lanes off instead of branching: a loop that tests first executes its body once more
// with all lanes masked off (frames take 1 / 0.65 times as long), so these test at the end, and their bodies test again whether this
// lane has work. What is found is what plain.glsl finds, bit by bit.
#ifndef SPLATRAY_MASKED_GLSL
#define SPLATRAY_MASKED_GLSL
#include "trace/cluster.glsl"

/// ADVANCE to the leaf behind walk.t_out, unless that is outside the root or behind t_end.
void walk_advance(INOUT(Walk) walk, Ray ray, float t_end, INOUT(Tally) tally) {
  walk.t_in = walk.t_out;
  walk.inside = (walk.cell.x | walk.cell.y | walk.cell.z) < CELL_LIMIT && walk.t_in <= t_end && walk.leaves < MAX_LEAVES;
  if (COUNTERS) tally.lost += walk.leaves == MAX_LEAVES ? 1u : 0u;
  uint steps = walk_descend(walk, ray);
  if (walk.filled != NO_LEAF && slab_missed(walk_crossing(slab_word(walk.filled), walk, ray))) walk.filled = NO_LEAF;
  walk.leaves += 1u;
  if (COUNTERS) tally.node_steps += steps;
  if (COUNTERS) tally.leaves += 1u;
}

/// The current leaf's splats that the ray may meet.
void walk_list(INOUT(Walk) walk, Ray ray) {
  walk.begin = 0u;
  walk.end = 0u;
  if (walk.filled != NO_LEAF) {
    uint slab = slab_word(walk.filled);
    walk.begin = begin_end_at(walk.filled);
    walk.end = begin_end_at(walk.filled + 1u);
    slab_halves(slab, walk_crossing(slab, walk, ray), walk.begin, walk.end);
  }
  walk.next = walk.begin;
}

/// TEST: the ray's next candidates: bit i of the answer is splat chunk + i. Goes from leaf to leaf until
/// there are some or the walk ends; with `stay`, no further than the end of this leaf. Two splats per iteration: updating lane
/// masks costs a third of a test on llvmpipe.
uint walk_candidates(INOUT(Walk) walk, Ray ray, float t_end, bool stay, OUT(uint) chunk, INOUT(Tally) tally) {
  uint candidates = 0u;
  bool searching = walk.inside;
  chunk = walk.next;
  do {
    bool advances = searching && walk.next >= walk.end && !stay;
    bool advancing = advances;
    do {
      if (advancing) walk_advance(walk, ray, t_end, tally);
      advancing = advancing && walk.inside && walk.filled == NO_LEAF;
    } while (advancing);
    if (advances) walk_list(walk, ray);
    chunk = walk.next;
    uint chunk_end = walk.inside ? min(chunk + CHUNK, walk.end) : chunk;
    uint bit = 1u;
    do {
      if (walk.next < chunk_end) {
        uint last = min(walk.next + 1u, chunk_end - 1u);
        uvec4 words = splat_words(splat_at(walk.next));
        uvec4 words_last = splat_words(splat_at(last));
        bool maybe = splat_maybe_hit(words, ray.origin, ray.dir, walk.t_in, walk.t_out);
        bool maybe_last = splat_maybe_hit(words_last, ray.origin, ray.dir, walk.t_in, walk.t_out);
        candidates |= (maybe ? bit : 0u) | (maybe_last ? bit << (last - walk.next) : 0u);
        bit <<= 2u;
        walk.next = last + 1u;
      }
    } while (walk.next < chunk_end);
    if (COUNTERS) tally.tests += chunk_end - chunk;
    searching = walk.inside && candidates == 0u && !(stay && walk.next >= walk.end);
  } while (searching);
  return candidates;
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

/// Adds the candidates that are hits and belong to the first splat's cluster: bit i of x is splat chunk + i, of y splat
/// chunk + CHUNK + i. Where each is met is computed anew in double-float, so that grazing rays and small discs far away have
/// exact weights.
void accumulate_candidates(uint chunk, uvec2 candidates, Ray ray, Walk walk, First first, float depth, uvec4 target,
                           INOUT(Cluster) cluster) {
  Window window = window_of(first, ray, depth);
  do {
    if ((candidates.x | candidates.y) != 0u) {
      bool low = candidates.x != 0u;
      uint mask = low ? candidates.x : candidates.y;
      uint splat = splat_at(chunk + (low ? 0u : CHUNK) + uint(findLSB(mask)));
      mask &= mask - 1u;
      candidates = low ? uvec2(mask, candidates.y) : uvec2(0u, mask);
      uvec4 words = splat_words(splat);
      PlaneHit hit = meet_splat(splat, words, ray);
      bool member = is_member(words, hit, ray, window, cluster) &&
                    hit_accepted(words, splat, hit, ray, walk.t_in, walk.t_out);
      add_splat(splat, words, hit, member, ray, window, target, cluster);
    }
  } while ((candidates.x | candidates.y) != 0u);
}

/// What the ray sees first, and whether a splat is a member of it, by the octree. The ray may start anywhere; one that ends
/// before it starts is not traced. The leaf with the first hit is looked through to its end before any of its splats is
/// accumulated; one of more than two CHUNKs is then gone through again.
Hit trace_octree(Ray ray, float kappa, uvec4 target, INOUT(Tally) tally) {
  bool enters = true;
  float t_start = 0.0f;
  float shift = clip_to_root(ray, enters, t_start);
  if (WATCHES) enters = enters && ray.t_max >= 0.0f;
  Walk walk = walk_start(ray, t_start, enters);
  First first = no_first();
  uint chunk = 0u;
  uint candidates = 0u;
  uvec2 hits = uvec2(0u, 0u);  // of this leaf: none in the leaves before
  bool found = false;
  uint counted = 0u;
  do {
    candidates = walk_candidates(walk, ray, ray.t_max, found, chunk, tally);
    candidates = accept_candidates(chunk, candidates, ray, walk, true, first);
    hits = uvec2(chunk == walk.begin ? candidates : hits.x, chunk == walk.begin + CHUNK ? candidates : hits.y);
    counted += uint(bitCount(candidates));
    found = is_found(first) && BLEND != BLEND_COUNT;
  } while (walk.inside && !(found && walk.next >= walk.end));
  Cluster cluster = empty_cluster();
  float depth = 0.0f;
  if (BLEND == BLEND_COUNT) {
    cluster.members = counted;
  } else if (has_cluster()) {
    depth = window_depth(first, ray.dir, kappa);
    float t_end = BLEND == BLEND_WINDOW ? window_end(first, depth) : ray.t_max;
    uint last_leaf = BLEND == BLEND_WINDOW ? MAX_LEAVES : (BLEND == BLEND_PAPER ? walk.leaves + 1u : walk.leaves);
    bool again = walk.end - walk.begin > 2u * CHUNK;
    walk.next = again ? walk.begin : walk.next;
    hits = again ? uvec2(0u, 0u) : hits;
    chunk = walk.begin;
    do {
      accumulate_candidates(chunk, hits, ray, walk, first, depth, target, cluster);
      bool last = walk.leaves >= last_leaf;
      walk.inside = walk.inside && (walk.next < walk.end || (!last && walk.t_out <= t_end));
      hits = uvec2(walk_candidates(walk, ray, t_end, last, chunk, tally), 0u);
    } while (hits.x != 0u);
  }
  return finish_hit(ray, first, cluster, depth, shift, target);
}

#endif
