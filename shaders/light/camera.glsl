// Pixel -> primary ray. Pixel centres are at +0.5, the top row first; FrameParams holds the ray as a plane of
// points and of directions, computed in float64 (engine/image/view.h), so that far eyes lose nothing. Needs
// `frame`, which holds the axes of a panorama.
#ifndef SPLATRAY_CAMERA_GLSL
#define SPLATRAY_CAMERA_GLSL
#ifdef LIT
#include "light/sampling.glsl"
#endif
#include "trace/region.glsl"

/// Cosine and sine of an angle in turns, -1 to 1, to 2e-7: a device's own may be off by 2^-11 (Vulkan 1.3, "Precision and Operation of
/// SPIR-V Instructions"), a third of a pixel of a panorama 4096 wide. Series of the angle from the nearest eighth turn on.
vec2 cosine_sine(float turns) {
  float quarter = floor(4.0f * turns + 0.5f);
  float a = 6.28318531f * (turns - 0.25f * quarter);
  float b = a * a;
  float sine = a * (1.0f + b * (-0.166666667f + b * (0.00833333333f + b * (-1.98412698e-4f + b * 2.75573192e-6f))));
  float cosine = 1.0f + b * (-0.5f + b * (0.0416666667f + b * (-0.00138888889f + b * 2.48015873e-5f)));
  int turned = int(quarter) & 3;
  vec2 near = (turned & 1) == 0 ? vec2(cosine, sine) : vec2(-sine, cosine);
  return (turned & 2) == 0 ? near : -near;
}

/// Direction through a pixel position of a panorama, of unit length.
vec3 panorama_direction(float x, float y) {
  vec2 longitude = cosine_sine(x * frame.panorama.x - 0.5f);
  vec2 from_top = cosine_sine(0.5f * y * frame.panorama.y);
  return from_top.y * (longitude.x * frame.dir_00 + longitude.y * frame.dir_dx) - from_top.x * frame.dir_dy;
}

/// The ray through pixel position (x, y), direction of unit length; `eye_distance` is the distance from the
/// eye to its t = 0.
Ray primary_ray(float x, float y, OUT(float) eye_distance) {
  Ray ray;
  vec3 dir = frame.panorama.x > 0.0f ? panorama_direction(x, y)
                                     : frame.dir_00 + frame.dir_dx * x + frame.dir_dy * y;
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
