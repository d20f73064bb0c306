// Pixel -> primary ray. Pixel centres are at +0.5, the top row first; FrameParams holds the ray as a plane of
// points and of directions, computed in float64 (engine/image/view.h), so that far eyes lose nothing. Needs
// `frame`.
#ifndef SPLATRAY_CAMERA_GLSL
#define SPLATRAY_CAMERA_GLSL
#ifdef LIT
#include "light/sampling.glsl"
#endif
#include "trace/region.glsl"

/// The ray through pixel position (x, y), direction of unit length; `eye_distance` is the distance from the
/// eye to its t = 0.
Ray primary_ray(float x, float y, OUT(float) eye_distance) {
  Ray ray;
  vec3 dir = frame.dir_00 + frame.dir_dx * x + frame.dir_dy * y;
  float length_dir = length(dir);
  eye_distance = frame.depth_offset + frame.depth_per_dir * length_dir;
  ray.origin = frame.origin_00 + frame.origin_dx * x + frame.origin_dy * y;
  ray.origin_low = vec3(0.0f);
  ray.dir = dir * (1.0f / length_dir);
  ray.t_min = frame.t_min;
  ray.t_max = INFINITY_F;
  ray.inside = 0u;
  ray.from_normal = vec3(0.0f);
  ray.from_object = NO_OBJECT;
  ray = unbounded(ray);
  ray.bounded = REGION;
  return ray;
}

#ifdef LIT
/// A primary ray from a point of the lens instead of its middle, to the same point of the sharp plane. `eye_distance` as
/// primary_ray has it.
Ray through_lens(Ray ray, float eye_distance, vec2 random) {
  vec2 at = disc_sample(random);
  vec3 beside = frame.lens_u * at.x + frame.lens_v * at.y;
  vec3 forward = cross(frame.lens_u, frame.lens_v);
  forward *= inversesqrt(dot(forward, forward));
  float sharp = frame.focus / dot(ray.dir, forward);
  ray.origin += beside * (1.0f - eye_distance / sharp);
  ray.dir -= beside / sharp;
  ray.dir *= inversesqrt(dot(ray.dir, ray.dir));
  return ray;
}
#endif

#endif
