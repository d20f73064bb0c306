// The octree along a ray: from leaf to leaf by descent from the root (Goradia et al. 2010, sec. IV-B;
// Lefebvre et al. 2005), with integer cells, so that no ray can be stuck or skip a cell. The leaves'
// intervals [t_in, t_out) tile the ray. Needs top_entry(index), node_word(index), begin_end_at(index),
// slab_word(index), splat_at(place), splat_words(splat).
#ifndef SPLATRAY_WALK_GLSL
#define SPLATRAY_WALK_GLSL
#include "trace/hit.glsl"
#include "trace/region.glsl"
#include "scene/slab.glsl"

const float ROOT_SIZE = 2097152.0f;      ///< 2^LATTICE_BITS
const uint CELL_LIMIT = 1u << LATTICE_BITS;
const uint MAX_LEAVES = 65536u;          ///< iteration cap; a ray that reaches it is counted as lost

const uint NO_LEAF = 0xFFFFFFFFu;
const uint CHUNK = 32u;                  ///< splats whose candidates one word records

/// Where a ray is in the octree.
struct Walk {
  vec3 inverse;    ///< 1 / direction
  bvec3 parallel;  ///< to the planes of an axis, so that `inverse` is unused there
  uint ahead;      ///< the bits of an empty leaf's word that hold the space ahead
  uvec3 cell;      ///< a lattice cell inside the next leaf; one coordinate is >= CELL_LIMIT outside the root
  float t_in;      ///< the current leaf's interval; t_in never decreases
  float t_out;
  vec3 center;     ///< its cell's
  float half_size;
  uint filled;     ///< its index in Begin-End, NO_LEAF where it is empty or the ray passes beside its slab
  uint begin;      ///< its splats that the ray may meet, none where there is no such leaf
  uint end;
  uint leaves;     ///< visited
};

/// Directions below this are parallel to the axis' planes: over the whole root they move a ray by less than
/// 2^-40 units.
const float PARALLEL = 1e-20f;

/// t at which the ray meets the plane `plane` of one axis, +inf if it runs parallel to it.
float plane_t(uint plane, float origin, float inverse, bool parallel) {
  return parallel ? INFINITY_F : (float(plane) - origin) * inverse;
}

uint cell_coordinate(float position, uint low, uint high) {
  return uint(clamp(floor(position), float(low), float(high)));
}

uvec3 cell_at(Ray ray, float t, uvec3 low, uvec3 high) {
  return uvec3(cell_coordinate(ray.origin.x + ray.dir.x * t, low.x, high.x),
               cell_coordinate(ray.origin.y + ray.dir.y * t, low.y, high.y),
               cell_coordinate(ray.origin.z + ray.dir.z * t, low.z, high.z));
}

/// Moves the origin of a ray to where it enters the root or to t_min, whichever is later, exactly
/// (double-float), with t_min and t_max. Returns by how much t became smaller; `enters` is false when the ray
/// misses the root, `t_start` is where its walk begins. An origin inside the root stays, exact as it is: in the plane
/// of a disc it lies on, any rounding would move the hit. So does a secondary ray's, by which the sheet left is known,
/// also when the surface between discs lies a little outside the root: walk_start takes the nearest cell. One that starts more
/// than a root's side outside has left no sheet. The ray also ends where the region does, if there is one; `enters` is false
/// where it misses that.
float clip_to_root(INOUT(Ray) ray, OUT(bool) enters, OUT(float) t_start) {
  float t_enter = ray.t_min;
  float t_exit = ray.t_max;
  bool beside = false;
  for (int axis = 0; axis < 3; ++axis) {
    float inverse = 1.0f / ray.dir[axis];
    float at_low = (0.0f - ray.origin[axis]) * inverse;
    float at_high = (ROOT_SIZE - ray.origin[axis]) * inverse;
    bool parallel = abs(ray.dir[axis]) < PARALLEL;
    beside = beside || (parallel && !(ray.origin[axis] >= 0.0f && ray.origin[axis] < ROOT_SIZE));
    t_enter = parallel ? t_enter : max(t_enter, min(at_low, at_high));
    t_exit = parallel ? t_exit : min(t_exit, max(at_low, at_high));
  }
  enters = !beside && t_enter <= t_exit && abs(t_enter) < INFINITY_F;
  vec3 from_middle = abs(ray.origin - vec3(0.5f * ROOT_SIZE));
  float farthest = max(from_middle.x, max(from_middle.y, from_middle.z));
  bool from_inside = farthest < 0.5f * ROOT_SIZE;
  bool at_surface = farthest < 1.5f * ROOT_SIZE && ray.from_object != NO_OBJECT;
  bool stays = from_inside || at_surface;
  ray.from_object = stays ? ray.from_object : NO_OBJECT;
  float shift = enters && !stays ? t_enter : 0.0f;
  t_start = stays ? min(t_enter, 0.0f) : 0.0f;
  for (int axis = 0; axis < 3; ++axis) {
    vec2 moved = df_add(two_product(shift, ray.dir[axis]), vec2(ray.origin[axis], ray.origin_low[axis]));
    ray.origin[axis] = moved.x;
    ray.origin_low[axis] = moved.y;
  }
  ray.t_min = ray.t_min - shift;
  ray.t_max = ray.t_max - shift;
  if (REGION) {
    clip_to_region(ray);
    enters = enters && ray.t_min < ray.t_max;
    t_start = region_start(ray, t_start);
  }
  return shift;
}

/// The ray's interval in the current leaf against its slab.
SlabCrossing walk_crossing(uint slab, Walk walk, Ray ray) {
  return slab_crossing(slab, ray, walk.t_in, walk.t_out, walk.center, walk.half_size);
}

/// Walk.ahead. Behind a ray its leaf ends with the cell: where float32 took a ray back behind planes of two axes that it has
/// passed, it could go in circles.
uint steps_ahead(vec3 dir) {
  return (dir.x > 0.0f ? 0xCu : 0x3u) | (dir.y > 0.0f ? 0xC0u : 0x30u) | (dir.z > 0.0f ? 0xC00u : 0x300u);
}

/// DESCEND from the top table, so from at most TOP_LEVELS below the root, to the leaf that holds walk.cell; finds the end of the
/// ray's interval in it, or in the empty space around an empty leaf, and the next leaf. Returns the number of node words read.
uint walk_descend(INOUT(Walk) walk, Ray ray) {
  // Behind the root's last leaf the cell lies outside: masked, as the children below are.
  uvec3 top_cell = (walk.cell >> (LATTICE_BITS - TOP_LEVELS)) & uvec3((1u << TOP_LEVELS) - 1u);
  uint top = top_entry(top_cell.x | (top_cell.y << TOP_LEVELS) | (top_cell.z << (2u * TOP_LEVELS)));
  bool top_is_leaf = (top >> NODE_TAG_SHIFT) != NODE_INNER;
  uint word = top_is_leaf ? top & TOP_LEAF_MASK : top;
  uint top_shift = LATTICE_BITS - (top_is_leaf ? (top & ~TOP_LEAF_MASK) >> TOP_LEAF_SHIFT : TOP_LEVELS);
  uint shift = top_shift;
  do {
    if ((word >> NODE_TAG_SHIFT) == NODE_INNER) {
      shift -= 1u;
      uint child = ((walk.cell.x >> shift) & 1u) | (((walk.cell.y >> shift) & 1u) << 1u) |
                   (((walk.cell.z >> shift) & 1u) << 2u);
      word = node_word((word & NODE_ADDRESS_MASK) + child);
    }
  } while ((word >> NODE_TAG_SHIFT) == NODE_INNER);
  uint size = 1u << shift;
  uvec3 low = uvec3(walk.cell.x & ~(size - 1u), walk.cell.y & ~(size - 1u), walk.cell.z & ~(size - 1u));
  walk.half_size = 0.5f * float(size);
  walk.center = vec3(low) + vec3(walk.half_size);
  uint steps = (word >> NODE_TAG_SHIFT) == NODE_EMPTY ? word & walk.ahead : 0u;
  uvec3 high = low + uvec3(size) + (uvec3((steps >> 2u) & 3u, (steps >> 6u) & 3u, (steps >> 10u) & 3u) << shift);
  low -= uvec3(steps & 3u, (steps >> 4u) & 3u, (steps >> 8u) & 3u) << shift;
  uvec3 next = uvec3(ray.dir.x > 0.0f ? high.x : low.x, ray.dir.y > 0.0f ? high.y : low.y,
                     ray.dir.z > 0.0f ? high.z : low.z);
  float t_x = plane_t(next.x, ray.origin.x, walk.inverse.x, walk.parallel.x);
  float t_y = plane_t(next.y, ray.origin.y, walk.inverse.y, walk.parallel.y);
  float t_z = plane_t(next.z, ray.origin.z, walk.inverse.z, walk.parallel.z);
  bool x_first = t_x <= t_y && t_x <= t_z;
  bool y_first = !x_first && t_y <= t_z;
  uint plane = x_first ? next.x : (y_first ? next.y : next.z);
  float dir = x_first ? ray.dir.x : (y_first ? ray.dir.y : ray.dir.z);
  uint exit_cell = dir > 0.0f ? plane : plane - 1u;
  walk.t_out = max(x_first ? t_x : (y_first ? t_y : t_z), walk.t_in);
  walk.filled = (word >> NODE_TAG_SHIFT) == NODE_FILLED ? word & NODE_ADDRESS_MASK : NO_LEAF;
  uvec3 cell = cell_at(ray, walk.t_out, low, high - uvec3(1u));
  walk.cell = uvec3(x_first ? exit_cell : cell.x, y_first ? exit_cell : cell.y, x_first || y_first ? cell.z : exit_cell);
  return top_shift - shift + 1u;
}

/// Before the first leaf of a ray that is inside the root at t_start.
Walk walk_start(Ray ray, float t_start) {
  Walk walk;
  walk.inverse = vec3(1.0f / ray.dir.x, 1.0f / ray.dir.y, 1.0f / ray.dir.z);
  walk.parallel = bvec3(abs(ray.dir.x) < PARALLEL, abs(ray.dir.y) < PARALLEL, abs(ray.dir.z) < PARALLEL);
  walk.ahead = steps_ahead(ray.dir);
  walk.cell = cell_at(ray, t_start, uvec3(0u), uvec3(CELL_LIMIT - 1u));
  walk.t_in = ray.t_min;
  walk.t_out = ray.t_min;
  walk.center = vec3(0.0f);
  walk.half_size = 0.0f;
  walk.filled = NO_LEAF;
  walk.begin = 0u;
  walk.end = 0u;
  walk.leaves = 0u;
  return walk;
}

#endif
