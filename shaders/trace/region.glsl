// The part of a ray that is in the region which a picture shows: a convex body, so an interval of t, without a box, so without a
// part of that interval. Hits are decided as without a region, and count where their t is in it, so what is found does not depend on
// the tree. Needs the constant REGION, region_plane(index), region_kept(), region_dropped(), region_light().
#ifndef SPLATRAY_REGION_GLSL
#define SPLATRAY_REGION_GLSL
#include "primitive/disc.glsl"

/// Before its walk, a ray whose interval begins inside the root looks this far back for the cell that it is in, lattice units:
/// more than float32 may be off there.
const float REGION_SLACK = 4.0f;

/// Beyond it, lattice units, there is nothing to meet: so far float32's t tells enough, and no quotient overflows.
const float REGION_FAR = 1e12f;

/// A ray that no region ends.
Ray unbounded(Ray ray) {
  ray.to_light = false;
  ray.bounded = false;
  ray.t_drop_in = INFINITY_F;
  ray.t_drop_out = INFINITY_F;
  return ray;
}

/// How a ray meets a plane n.x = w: at t, towards the side that n points to where `facing` is positive, and whether it starts
/// there.
struct PlaneCrossing {
  float t;
  float facing;
  bool inside;
};

PlaneCrossing cross_plane(vec4 plane, Ray ray) {
  PlaneCrossing crossing;
#ifdef HOST
  dvec3 n = dvec3(vec3(plane));
  PRECISE double height = dot(n, dvec3(ray.origin)) + dot(n, dvec3(ray.origin_low)) - double(plane.w);
  PRECISE double facing = dot(n, dvec3(ray.dir));
  crossing.t = float(-height / facing);
  crossing.facing = float(facing);
  crossing.inside = height >= 0.0;
#else
  vec2 height = vec2(-plane.w, 0.0f);
  vec2 facing = vec2(0.0f);
  for (int axis = 0; axis < 3; ++axis) {
    height = df_add(height, df_scale(vec2(ray.origin[axis], ray.origin_low[axis]), plane[axis]));
    facing = df_add(facing, two_product(plane[axis], ray.dir[axis]));
  }
  crossing.t = -height.x / facing.x;
  if (abs(crossing.t) < REGION_FAR) crossing.t = df_divide(-height, facing).x;
  crossing.facing = facing.x;
  crossing.inside = height.x >= 0.0f;
#endif
  return crossing;
}

/// Narrows (t_in, t_out) to where the ray is on the inner side of planes begin to end - 1.
void keep_inside(Ray ray, uint begin, uint end, INOUT(float) t_in, INOUT(float) t_out) {
  uint i = begin;
  do {
    if (i < end) {
      PlaneCrossing crossing = cross_plane(region_plane(i), ray);
      bool beside = crossing.facing == 0.0f && !crossing.inside;
      t_in = crossing.facing > 0.0f ? max(t_in, crossing.t) : t_in;
      t_out = beside ? -INFINITY_F : (crossing.facing < 0.0f ? min(t_out, crossing.t) : t_out);
    }
    i += 1u;
  } while (i < end);
}

/// Ends a ray where the region ends; t_min >= t_max where it does not meet it.
void clip_to_region(INOUT(Ray) ray) {
  if (ray.bounded) {
    keep_inside(ray, 0u, region_kept(), ray.t_min, ray.t_max);
    ray.t_drop_in = region_dropped() > 0u ? -INFINITY_F : INFINITY_F;
    ray.t_drop_out = INFINITY_F;
    keep_inside(ray, region_kept(), region_kept() + region_dropped(), ray.t_drop_in, ray.t_drop_out);
  }
}

/// Whether anything may be met at t, of rays after clip_to_region.
bool region_keeps(Ray ray, float t) { return !(t > ray.t_drop_in && t < ray.t_drop_out); }

/// Where the walk of a ray begins that would begin at t_start without a region.
float region_start(Ray ray, float t_start) { return max(t_start, ray.t_min - REGION_SLACK); }

#endif
