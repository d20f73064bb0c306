#include "tests/light/vertex_twin.h"

#include <bit>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>

#include "engine/scene/splat.h"
#include "shaders/lang/albedo_layout.h"

#define LIT

namespace splatray::testing {
namespace {

namespace glsl {

#include "shaders/lang/glsl_as_cpp.h"
//
#include "engine/cpu/bindings_as_cpp.h"
//
#include "shaders/stage/trace.glsl"

// No rays are traced.
Hit trace_watching(const Ray&, float, uvec4, Tally&) { return {}; }
Passing trace_shadow(Ray, Tally&) { return all_passing(); }

vec3 vector_at(const VectorsOfPlaces& values, uint i) { return {values[0][i], values[1][i], values[2][i]}; }

}  // namespace glsl
}  // namespace

TwinVertex twin_vertex(const KernelWork& work, const WideVertices& vertices, std::uint32_t i) {
  using namespace glsl;
  glsl::bound = &work;
  const uint pixel = vertices.pixel[i], sample = vertices.sample[i], bounce = vertices.bounce[i];
  const vec3 dir = vector_at(vertices.dir, i);
  Hit hit{};
  hit.normal = hit.plane = vector_at(vertices.normal, i);
  hit.object = vertices.object[i];
  const Material material = material_at(hit.object);
  hit.color = vector_at(vertices.base, i) / material.base;
  const Basis basis = basis_of(hit.normal);
  const auto to_own = [&](const vec3& v) {
    return vec3(dot(v, basis.u), dot(v, basis.v), dot(v, hit.normal));
  };
  vec3 to_eye = to_own(-dir);
  to_eye.z = max(to_eye.z, 1e-6f);
  const Bsdf bsdf = bsdf_at(hit, material, 1.0f, to_eye.z);
  const vec4 random = sobol_sample(pixel, sample, 1u + 2u * bounce, frame.seed);
  TwinVertex twin{};
  twin.light_random = vec3(random);
  vec2 at(0.0f);
  twin.light_dir = sky_sample(vec2(random), at, twin.light_pdf);
  twin.radiance = environment_at(at);
  twin.value = bsdf_value(bsdf, to_eye, to_own(twin.light_dir), twin.value_pdf);
  const vec4 onward = sobol_sample(pixel, sample, 2u + 2u * bounce, frame.seed);
  const BsdfSample next = bsdf_sample(bsdf, to_eye, vec3(onward));
  twin.next_dir = basis.u * next.dir.x + basis.v * next.dir.y + hit.normal * next.dir.z;
  twin.weight = next.weight;
  twin.next_pdf = next.pdf;
  twin.next_random = onward.w;
  return twin;
}

TwinEscape twin_escape(const KernelWork& work, const glm::vec3& dir) {
  using namespace glsl;
  glsl::bound = &work;
  const vec3 own = to_environment(dir);
  const vec2 at = environment_position(own);
  return {environment_at(at), sky_pdf(own, at)};
}

}  // namespace splatray::testing
