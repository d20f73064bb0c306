// RayQuery -> RayHit (layout.h). Needs what blend.glsl needs.
#ifndef SPLATRAY_QUERY_GLSL
#define SPLATRAY_QUERY_GLSL
#include "trace/blend.glsl"

Ray query_ray(RayQuery query, float delta) {
  Ray ray;
  ray.origin = query.origin;
  ray.origin_low = vec3(0.0f);
  ray.dir = query.dir;
  ray.t_min = SIDE == SIDE_DELTA && query.from_object != NO_OBJECT ? max(query.t_min, delta) : query.t_min;
  ray.t_max = query.t_max > 0.0f ? query.t_max : INFINITY_F;
  ray.inside = query.inside;
  ray.from_normal = query.from_normal;
  ray.from_object = query.from_object;
  ray = unbounded(ray);
  ray.bounded = REGION;
  return ray;
}

/// 8 bits a channel, square-root encoded, as in the colour pool.
uint encode_color(vec3 linear) {
  uint r = uint(sqrt(clamp(linear.x, 0.0f, 1.0f)) * 255.0f + 0.5f);
  uint g = uint(sqrt(clamp(linear.y, 0.0f, 1.0f)) * 255.0f + 0.5f);
  uint b = uint(sqrt(clamp(linear.z, 0.0f, 1.0f)) * 255.0f + 0.5f);
  return r | (g << 8u) | (b << 16u) | 0xFF000000u;
}

RayHit answer_query(RayQuery query, float kappa, float delta, INOUT(Tally) tally) {
  Hit hit = trace_nearest(query_ray(query, delta), kappa, tally);
  RayHit answer;
  answer.normal = hit.found ? hit.normal : vec3(0.0f);
  answer.t = hit.t;
  answer.first = hit.first;
  answer.t_first = hit.t_first;
  answer.object = hit.object;
  answer.members = hit.members;
  answer.color = COLORS && hit.found ? encode_color(hit.color) : 0u;
  return answer;
}

#endif
