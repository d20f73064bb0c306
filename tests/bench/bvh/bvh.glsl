// What a ray hits, found in a wide bounding volume hierarchy (bvh.h) instead of the octree: included behind bindings.glsl,
// it takes the place of trace.glsl's trace_nearest and trace_shadow. All that decides and sums hits is trace.glsl's. For
// BLEND_WINDOW and BLEND_NEAREST; shadows of dielectrics are black. As in traverse.glsl, loops test at their end.
#ifndef SPLATRAY_BVH_GLSL
#define SPLATRAY_BVH_GLSL
#define trace_nearest trace_nearest_in_octree
#define trace_shadow trace_shadow_in_octree
#include "trace/trace.glsl"
#undef trace_nearest
#undef trace_shadow

const uint BVH_STRIDE = 3u;          ///< texels of a node
const uint BVH_DEPTH = 32u;          ///< most nodes on the way to a splat
const uint BVH_LIST = 16u;           ///< most nodes whose accepted splats are kept for blending
const uint BVH_ADDRESS = 0xFFFFFFu;  ///< bits 23..0: a node or a splat
const uint BVH_ONE = 0x40000000u;    ///< one child in a group
const float BVH_STEEPEST = 1e20f;    ///< most of 1 / direction: infinity times 0 is NaN
const float BVH_MARGIN = 1.5f;       ///< of the window while the first splat is not known yet
const int BVH_MISS = 0x7FFFFFFF;
const int BVH_PLACE = 3;             ///< bits of a child's distance that tell which child it is

/// What the ray left on its way down, groups: where a node's children begin, bits 23..0; which of them are left to visit,
/// nearest first, 2 bits each from 24 on; how many, 31..30. Private, not shared: llvmpipe is slower with shared memory.
uint bvh_stack[BVH_DEPTH];

/// The ray's accepted splats in the order in which they were found: child 0 of their node as in BvhWalk, bits 23..0, and
/// which children, 27..24.
uint bvh_accepted[BVH_LIST];

/// Where a ray is in the hierarchy.
struct BvhWalk {
  vec3 inverse;   ///< 1 / direction
  uint nodes;     ///< texel of node 0
  int nearest;    ///< which child of the group to visit next; negative: one of the stack's
  uint group;     ///< with the other children
  uint depth;     ///< of the stack
  uint chunk;     ///< child 0 of the last node visited if it were a splat
};

float bvh_inverse(float dir) {
  return abs(dir) < 1.0f / BVH_STEEPEST ? (dir < 0.0f ? -BVH_STEEPEST : BVH_STEEPEST) : 1.0f / dir;
}

/// Before the root, or at the end for a ray that is not to look at all.
BvhWalk bvh_start(Ray ray, bool enters) {
  BvhWalk walk;
  walk.inverse = vec3(bvh_inverse(ray.dir.x), bvh_inverse(ray.dir.y), bvh_inverse(ray.dir.z));
  walk.nodes = node_word(0u) & NODE_ADDRESS_MASK;
  walk.nearest = enters ? 0 : -1;
  walk.group = 0u;
  walk.depth = 0u;
  walk.chunk = 0u;
  return walk;
}

bool bvh_alive(BvhWalk walk) { return walk.nearest >= 0 || walk.depth != 0u; }

/// The node to visit next; what else is in its group goes to the stack.
uint bvh_next(INOUT(BvhWalk) walk) {
  if (walk.nearest < 0) {
    walk.depth -= 1u;
    uint group = bvh_stack[walk.depth];
    walk.nearest = int((group >> 24u) & 3u);
    walk.group = (group & BVH_ADDRESS) | ((group >> 2u) & 0xF000000u) | ((group & 0xC0000000u) - BVH_ONE);
  }
  if (walk.group >= BVH_ONE) {
    bvh_stack[walk.depth] = walk.group;
    walk.depth += 1u;
  }
  return (walk.group + uint(walk.nearest)) & BVH_ADDRESS;
}

/// Where the ray meets the planes of 4 children, as bits: their order is that of the numbers where none is negative.
ivec4 bvh_planes(uint bytes, float start, float step) {
  ivec4 q = ivec4((uvec4(bytes) >> uvec4(0u, 8u, 16u, 24u)) & 255u);
  return floatBitsToInt(vec4(start) + step * vec4(q));
}

/// Where the ray enters the boxes of a node's 4 children, in units after t_begin, as bits; BVH_MISS if it does not meet one
/// in [t_begin, t_end].
ivec4 bvh_boxes(uvec4 header, uvec4 xy, uvec4 z, BvhWalk walk, Ray ray, float t_begin, float t_end) {
  vec3 scale = uintBitsToFloat(((header.xyz >> 21u) + uvec3(127u)) << 23u);
  vec3 step = scale * walk.inverse;
  vec3 start = (vec3(ivec3(header.xyz & 0x1FFFFFu)) - ray.origin) * walk.inverse - vec3(t_begin);
  bool left = ray.dir.x < 0.0f;
  bool down = ray.dir.y < 0.0f;
  bool back = ray.dir.z < 0.0f;
  ivec4 in_x = bvh_planes(left ? xy.y : xy.x, start.x, step.x);
  ivec4 in_y = bvh_planes(down ? xy.w : xy.z, start.y, step.y);
  ivec4 in_z = bvh_planes(back ? z.y : z.x, start.z, step.z);
  ivec4 out_x = bvh_planes(left ? xy.x : xy.y, start.x, step.x);
  ivec4 out_y = bvh_planes(down ? xy.z : xy.w, start.y, step.y);
  ivec4 out_z = bvh_planes(back ? z.x : z.y, start.z, step.z);
  ivec4 t_in = max(max(in_x, in_y), max(in_z, ivec4(0)));
  ivec4 t_out = min(min(out_x, out_y), min(out_z, ivec4(floatBitsToInt(t_end - t_begin))));
  return mix(ivec4(BVH_MISS), t_in, lessThanEqual(t_in, t_out));
}

/// Makes the group of the children met: where their node's children begin, and where the ray meets them.
void bvh_sort(INOUT(BvhWalk) walk, uint children, ivec4 t) {
  ivec4 key = (t & ~BVH_PLACE) | ivec4(0, 1, 2, 3);
  ivec2 low = min(key.xz, key.yw);
  ivec2 high = max(key.xz, key.yw);
  int first = min(low.x, low.y);
  int last = max(high.x, high.y);
  int one = max(low.x, low.y);
  int other = min(high.x, high.y);
  ivec3 others = ivec3(min(one, other), max(one, other), last);
  uvec3 met = mix(uvec3(0u), uvec3(BVH_ONE), lessThan(others, ivec3(BVH_MISS & ~BVH_PLACE)));
  uvec3 places = uvec3(others & BVH_PLACE) << uvec3(24u, 26u, 28u);
  walk.nearest = first < (BVH_MISS & ~BVH_PLACE) ? first & BVH_PLACE : -1;
  walk.group = (children & BVH_ADDRESS) | places.x | places.y | places.z;
  walk.group += met.x + met.y + met.z;
}

/// Visits the next node. Which of its splats may the ray hit in [t_begin, t_end]?
uint bvh_visit(INOUT(BvhWalk) walk, Ray ray, float t_begin, float t_end) {
  uint at = walk.nodes + bvh_next(walk) * BVH_STRIDE;
  uvec4 header = splat_words(at);
  uvec4 xy = splat_words(at + 1u);
  uvec4 z = splat_words(at + 2u);
  ivec4 t = bvh_boxes(header, xy, z, walk, ray, t_begin, t_end);
  bvec4 is_splat = lessThan(uvec4(0u, 1u, 2u, 3u), uvec4(z.w));
  uvec4 splats = mix(uvec4(0u), mix(uvec4(1u, 2u, 4u, 8u), uvec4(0u), equal(t, ivec4(BVH_MISS))), is_splat);
  bvh_sort(walk, header.w, mix(t, ivec4(BVH_MISS), is_splat));
  walk.chunk = z.z;
  return splats.x | splats.y | splats.z | splats.w;
}

/// The next candidates of [t_begin, t_end]: bit i of the answer is splat walk.chunk + i. None at the end only.
uint bvh_candidates(INOUT(BvhWalk) walk, Ray ray, float t_begin, float t_end, INOUT(Tally) tally) {
  uint candidates = 0u;
  float begin = max(t_begin, EARLIEST);
  bool visiting = bvh_alive(walk);
  do {
    if (visiting) {
      candidates = bvh_visit(walk, ray, begin, t_end);
      if (COUNTERS == 1u) tally.node_steps += 1u;
    }
    visiting = visiting && candidates == 0u && bvh_alive(walk);
  } while (visiting);
  if (COUNTERS == 1u) tally.leaves += candidates != 0u ? 1u : 0u;
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
    accumulate_candidates(walk.chunk, uvec2(candidates, 0u), ray, whole_ray(ray), first, depth, cluster);
  } while (bvh_alive(walk));
}

/// Adds those of the first `count` entries of bvh_accepted that are in the first splat's cluster.
void bvh_accumulate(uint count, Ray ray, First first, float depth, INOUT(Cluster) cluster) {
  uint i = 0u;
  do {
    uint entry = i < count ? bvh_accepted[i] : 0u;
    accumulate_candidates(entry & BVH_ADDRESS, uvec2(entry >> 24u, 0u), ray, whole_ray(ray), first, depth, cluster);
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
