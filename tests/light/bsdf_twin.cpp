#include "tests/light/bsdf_twin.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "engine/table/albedo_table.h"
#include "shaders/lang/albedo_layout.h"

namespace splatray::testing {
namespace {

namespace glsl {

#include "shaders/lang/glsl_as_cpp.h"

constexpr bool LOBE_DIFFUSE = true, LOBE_SPECULAR = true, LOBE_METAL = true, LOBE_TRANSMISSION = true,
               LOBE_COAT = true;

float albedo_at(uint index) { return ALBEDO_TABLE[index]; }

#include "shaders/lang/sobol.glsl"
#include "shaders/light/bsdf.glsl"

}  // namespace glsl

glsl::Bsdf bsdf_of(const TwinSurface& surface, float cosine) {
  glsl::Bsdf bsdf{};
  bsdf.base = bsdf.tint = surface.base;
  bsdf.metallic = surface.metallic;
  bsdf.f0 = surface.f0;
  bsdf.f90 = surface.f90;
  bsdf.alpha = surface.alpha;
  bsdf.transmission = surface.transmission;
  bsdf.eta = surface.eta;
  bsdf.coat = surface.coat;
  bsdf.coat_alpha = surface.coat_alpha;
  glsl::bsdf_seen(bsdf, cosine);
  return bsdf;
}

}  // namespace

TwinValue twin_bsdf_value(const TwinSurface& surface, const glm::vec3& to_eye, const glm::vec3& to_light) {
  TwinValue answer;
  answer.value = glsl::bsdf_value(bsdf_of(surface, to_eye.z), to_eye, to_light, answer.pdf);
  return answer;
}

TwinSample twin_bsdf_sample(const TwinSurface& surface, const glm::vec3& to_eye, const glm::vec3& random) {
  const glsl::BsdfSample chosen = glsl::bsdf_sample(bsdf_of(surface, to_eye.z), to_eye, random);
  return {chosen.dir, chosen.weight, chosen.pdf, (chosen.event & glsl::BSDF_DELTA) != 0,
          (chosen.event & glsl::BSDF_TRANSMITTED) != 0};
}

glm::vec4 twin_sobol_sample(std::uint32_t pixel, std::uint32_t sample, std::uint32_t group,
                            std::uint32_t seed) {
  return glsl::sobol_sample(pixel, sample, group, seed);
}

}  // namespace splatray::testing
