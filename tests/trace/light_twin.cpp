#include "tests/trace/light_twin.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>

#include "shaders/lang/hit_numbers.h"

namespace splatray::testing {
namespace {

namespace glsl {

#include "shaders/lang/glsl_as_cpp.h"

#define SIDE SIDE_SIDE
#define ENVIRONMENT true
#define REGION false

thread_local FrameParams frame;

float medium_at(uint bit) { return frame.media[bit >> 2U][static_cast<int>(bit & 3U)]; }
vec3 environment_texel(vec2) { return vec3(0.0F); }
vec4 region_plane(uint index) { return frame.region[index]; }
uint region_kept() { return 0; }
uint region_dropped() { return 0; }
bool region_light() { return false; }

#include "shaders/lang/random.glsl"
#include "shaders/light/camera.glsl"
#include "shaders/light/environment.glsl"
#include "shaders/light/material.glsl"

}  // namespace glsl
}  // namespace

TwinRay twin_primary_ray(const FrameParams& frame, float x, float y) {
  glsl::frame = frame;
  float eye_distance = 0.0F;
  const glsl::Ray ray = glsl::primary_ray(x, y, eye_distance);
  return {ray.origin, ray.dir, ray.inside};
}

vec2 twin_pixel_sample(std::uint32_t index) { return glsl::pixel_sample(index); }

float twin_path_random(std::uint32_t pixel, std::uint32_t sample, std::uint32_t dimension,
                       std::uint32_t seed) {
  return glsl::path_random(pixel, sample, dimension, seed);
}

TwinFresnel twin_fresnel(float eta, float cosine) {
  TwinFresnel fresnel{};
  fresnel.share = glsl::fresnel(eta, cosine, fresnel.cosine_behind);
  return fresnel;
}

TwinCrossing twin_crossing(const FrameParams& frame, const TwinRay& ray, vec3 normal, bool front,
                           const Material& material, float choice) {
  glsl::frame = frame;
  glsl::Hit hit{};
  hit.normal = normal;
  hit.front = front;
  glsl::Ray from{};
  from.dir = ray.dir;
  from.inside = ray.inside;
  TwinCrossing crossing{};
  const glsl::Ray next = glsl::dielectric_ray(hit, from, material, choice, crossing.reflected);
  crossing.ray = {next.origin, next.dir, next.inside};
  return crossing;
}

vec2 twin_environment_position(vec3 dir) { return glsl::environment_position(dir); }

vec3 twin_to_environment(const FrameParams& frame, vec3 dir) {
  glsl::frame = frame;
  return glsl::to_environment(dir);
}

vec3 twin_environment_diffuse(const FrameParams& frame, vec3 normal) {
  glsl::frame = frame;
  return glsl::environment_diffuse(normal);
}

}  // namespace splatray::testing
