// What a ray hits, found in a wide bounding volume hierarchy (bvh.h) instead of the octree: included behind bindings.glsl,
// it takes the place of trace.glsl's trace_nearest and trace_shadow. All that decides and sums hits is trace.glsl's.
// BVH_WIDTH: children of a node. Blends BLEND_WINDOW and BLEND_NEAREST, no dielectrics.
#ifndef SPLATRAY_BVH_GLSL
#define SPLATRAY_BVH_GLSL
#define trace_nearest trace_nearest_in_octree
#define trace_shadow trace_shadow_in_octree
#include "trace.glsl"
#undef trace_nearest
#undef trace_shadow

const uint BVH_STRIDE = 1u + BVH_WIDTH / 2u;   ///< texels of a node
const uint BVH_DEPTH = 32u;                    ///< most nodes on the way to a splat
const float BVH_STEEPEST = 1e20f;              ///< most of 1 / direction: infinity times 0 is NaN
const uint BVH_LIST = 16u;                     ///< most nodes whose accepted splats are kept for blending
const float BVH_MARGIN = 1.5f;                 ///< of the window while the first splat is not known yet
const int BVH_MISS = 0x7FFFFFFF;

/// What each thread left on its way down: where a node's children begin, bits 23..0, and which of them are left to visit.
uint bvh_stack[BVH_DEPTH];

/// The accepted splats of a thread's ray, in the order in which they were found: child 0 of their node as in BvhWalk, bits
/// 23..0, and which children.
uint bvh_accepted[BVH_LIST];

/// Where a ray is in the hierarchy.
struct BvhWalk {
  vec3 inverse;   ///< 1 / direction
  uint nodes;     ///< texel of node 0
  uint group;     ///< as on the stack
  int nearest;    ///< which child of the group to visit next; negative: none
  uint depth;     ///< of the stack
  uint chunk;     ///< child 0 of the last node visited if it were a splat
  uint pending;   ///< its splats not looked at yet, bit i: chunk + i
};

float bvh_inverse(float dir) {
  return abs(dir) < 1.0f / BVH_STEEPEST ? (dir < 0.0f ? -BVH_STEEPEST : BVH_STEEPEST) : 1.0f / dir;
}

/// Before the root, or at the end for a ray that is not to look at all.
BvhWalk bvh_start(Ray ray, bool enters) {
  BvhWalk walk;
  walk.inverse = vec3(bvh_inverse(ray.dir.x), bvh_inverse(ray.dir.y), bvh_inverse(ray.dir.z));
  walk.nodes = node_word(0u) & NODE_ADDRESS_MASK;
  walk.group = enters ? 0x1000000u : 0u;
  walk.nearest = 0;
  walk.depth = 0u;
  walk.chunk = 0u;
  walk.pending = 0u;
  return walk;
}

bool bvh_alive(BvhWalk walk) { return (walk.group >> 24u) != 0u || walk.depth != 0u; }

/// Where the ray enters the box of child `place` of 4, as bits, which are in the order of the numbers as none is negative;
/// BVH_MISS if it does not before t_end.
int bvh_child(uint place, uvec3 near, uvec3 far, vec3 start, vec3 step, int t_end) {
  uint shift = 8u * place;
  ivec3 t_near = floatBitsToInt(start + step * vec3(ivec3((near >> shift) & 0xFFu)));
  ivec3 t_far = floatBitsToInt(start + step * vec3(ivec3((far >> shift) & 0xFFu)));
  int t_in = max(max(t_near.x, t_near.y), max(t_near.z, 0));
  int t_out = min(min(t_far.x, t_far.y), min(t_far.z, t_end));
  return t_in <= t_out ? t_in : BVH_MISS;
}

/// Goes to the next child of the group, or of the last group of the stack; which of its children does the ray meet in
/// [t_begin, t_end]?
void bvh_visit(INOUT(BvhWalk) walk, Ray ray, float t_begin, float t_end) {
  if ((walk.group >> 24u) == 0u) {
    walk.depth -= 1u;
    walk.group = bvh_stack[walk.depth];
    walk.nearest = findLSB(walk.group >> 24u);
  }
  uint child = uint(walk.nearest);
  uint node = (walk.group + child) & 0xFFFFFFu;
  walk.group &= ~(0x1000000u << child);
  if ((walk.group >> 24u) != 0u) {
    bvh_stack[walk.depth] = walk.group;
    walk.depth += 1u;
  }
  uint at = walk.nodes + node * BVH_STRIDE;
  uvec4 header = splat_words(at);
  vec3 scale = uintBitsToFloat(((header.xyz >> 21u) + uvec3(127u)) << 23u);
  vec3 start = (vec3(ivec3(header.xyz & 0x1FFFFFu)) - ray.origin) * walk.inverse - vec3(t_begin);
  vec3 step = scale * walk.inverse;
  int t_last = floatBitsToInt(t_end - t_begin);
  uint hits = 0u;
  uint splats = 0u;
  int nearest = BVH_MISS;
  for (uint quad = 0u; quad < BVH_WIDTH / 4u; ++quad) {
    uvec4 xy = splat_words(at + 1u + 2u * quad);
    uvec4 z = splat_words(at + 2u + 2u * quad);
    if (quad == 0u) {
      walk.chunk = z.z;
      splats = (1u << z.w) - 1u;
    }
    uvec3 near = uvec3(ray.dir.x < 0.0f ? xy.y : xy.x, ray.dir.y < 0.0f ? xy.w : xy.z, ray.dir.z < 0.0f ? z.y : z.x);
    uvec3 far = uvec3(ray.dir.x < 0.0f ? xy.x : xy.y, ray.dir.y < 0.0f ? xy.z : xy.w, ray.dir.z < 0.0f ? z.x : z.y);
    for (uint place = 0u; place < 4u; ++place) {
      uint i = 4u * quad + place;
      int t_in = bvh_child(place, near, far, start, step, t_last);
      hits |= t_in == BVH_MISS ? 0u : 1u << i;
      bool is_splat = ((splats >> i) & 1u) != 0u;
      nearest = min(nearest, is_splat ? BVH_MISS : (t_in & ~7) | int(i));
    }
  }
  walk.group = (header.w & 0xFFFFFFu) | ((hits & ~splats) << 24u);
  walk.nearest = nearest & 7;
  walk.pending = hits & splats;
}

/// The next candidates of [t_begin, t_end]: bit i of the answer is splat walk.chunk + i. None at the end only.
uint bvh_candidates(INOUT(BvhWalk) walk, Ray ray, float t_begin, float t_end, INOUT(Tally) tally) {
  t_begin = max(t_begin, EARLIEST);
  walk.pending = 0u;
  bool visiting = bvh_alive(walk);
  do {
    if (visiting) {
      bvh_visit(walk, ray, t_begin, t_end);
      if (COUNTERS == 1u) tally.node_steps += 1u;
    }
    visiting = visiting && walk.pending == 0u && bvh_alive(walk);
  } while (visiting);
  uint candidates = walk.pending;
  if (COUNTERS == 1u) tally.leaves += walk.pending != 0u ? 1u : 0u;
  if (COUNTERS == 1u) tally.tests += uint(bitCount(candidates));
  return candidates;
}

/// All of the ray, for accept_candidates.
Walk whole_ray(Ray ray) {
  Walk walk;
  walk.t_in = ray.t_min;
  walk.t_out = INFINITY_F;
  return walk;
}

/// Adds the first splat's cluster, which lies in [t_begin, t_end], by a walk of its own.
void bvh_collect(Ray ray, bool needed, float t_begin, float t_end, First first, float depth, INOUT(Cluster) cluster,
                 INOUT(Tally) tally) {
  BvhWalk walk = bvh_start(ray, needed);
  do {
    uint candidates = bvh_candidates(walk, ray, t_begin, t_end, tally);
    uint accepted = accept_candidates(walk.chunk, candidates, ray, whole_ray(ray), false, first);
    accumulate_chunk(walk.chunk, accepted, ray, first, depth, cluster);
  } while (bvh_alive(walk));
}

/// Adds those of the first `count` entries of bvh_accepted that are in the first splat's cluster.
void bvh_accumulate(uint count, Ray ray, First first, float depth, INOUT(Cluster) cluster) {
  uint i = 0u;
  do {
    uint entry = i < count ? bvh_accepted[i] : 0u;
    accumulate_chunk(entry & 0xFFFFFFu, entry >> 24u, ray, first, depth, cluster);
    i += 1u;
  } while (i < count);
}

/// What the ray sees first. On the way to the first splat all accepted ones are noted, as far as a window behind the first
/// so far; where that was not far enough, or they were too many, the cluster is looked for again.
Hit trace_nearest(Ray ray, float kappa, INOUT(Tally) tally) {
  bool enters = true;
  float t_start = 0.0f;
  float shift = clip_to_root(ray, enters, t_start);
  First first = no_first();
  Cluster cluster = empty_cluster();
  float depth = 0.0f;
  float t_seen = ray.t_max;
  uint count = 0u;
  BvhWalk walk = bvh_start(ray, enters);
  do {
    t_seen = min(t_seen, first.t.x + BVH_MARGIN * depth + WINDOW_SLACK);
    uint candidates = bvh_candidates(walk, ray, ray.t_min, t_seen, tally);
    uint accepted = accept_candidates(walk.chunk, candidates, ray, whole_ray(ray), true, first);
    if (BLEND != BLEND_NEAREST) {
      depth = window_depth(first, ray.dir, kappa);
      if (accepted != 0u && count < BVH_LIST)
        bvh_accepted[count] = walk.chunk | (accepted << 24u);
      count += accepted != 0u ? 1u : 0u;
    }
  } while (bvh_alive(walk));
  if (BLEND != BLEND_NEAREST) {
    float t_end = min(first.t.x + depth * 1.0001f + WINDOW_SLACK, ray.t_max);
    bool again = first.measure.x < INFINITY_F && (count > BVH_LIST || t_end > t_seen);
    bvh_accumulate(again ? 0u : count, ray, first, depth, cluster);
    bvh_collect(ray, again, first.t.x - WINDOW_SLACK, t_end, first, depth, cluster, tally);
  }
  return finish_hit(ray, first, cluster, depth, shift);
}

vec3 trace_shadow(Ray ray, INOUT(Tally) tally) {
  First first = no_first();
  BvhWalk walk = bvh_start(ray, true);
  bool opaque = false;
  do {
    uint candidates = bvh_candidates(walk, ray, ray.t_min, ray.t_max, tally);
    opaque = accept_candidates(walk.chunk, candidates, ray, whole_ray(ray), false, first) != 0u;
  } while (!opaque && bvh_alive(walk));
  return vec3(opaque ? 0.0f : 1.0f);
}

#endif
