/// The shaders' maths of light, compiled as C++: camera, random numbers, Fresnel and refraction, environment.
#pragma once
#include <array>

#include "shaders/layout.h"

namespace splatray::testing {

struct TwinRay {
  vec3 origin, dir;
  std::uint32_t inside = 0;  ///< mask of dielectrics
};

/// The ray through a pixel position, root space (light/camera.glsl).
[[nodiscard]] TwinRay twin_primary_ray(const FrameParams& frame, float x, float y);

/// lang/random.glsl.
[[nodiscard]] vec2 twin_pixel_sample(std::uint32_t index);
[[nodiscard]] float twin_path_random(std::uint32_t pixel, std::uint32_t sample, std::uint32_t dimension,
                                     std::uint32_t seed);

/// Share reflected, and |n.d| of the refracted ray (light/material.glsl).
struct TwinFresnel {
  float share, cosine_behind;
};
[[nodiscard]] TwinFresnel twin_fresnel(float eta, float cosine);

/// How a ray goes on from a dielectric's face with this normal, turned against the ray; `front`: from outside. `frame` holds the
/// indices of refraction of the other dielectrics.
struct TwinCrossing {
  TwinRay ray;
  bool reflected;
};
[[nodiscard]] TwinCrossing twin_crossing(const FrameParams& frame, const TwinRay& ray, vec3 normal,
                                         bool front, const Material& material, float choice);

/// light/environment.glsl.
[[nodiscard]] vec2 twin_environment_position(vec3 dir);
[[nodiscard]] vec3 twin_to_environment(const FrameParams& frame, vec3 dir);
[[nodiscard]] vec3 twin_environment_diffuse(const FrameParams& frame, vec3 normal);

}  // namespace splatray::testing
