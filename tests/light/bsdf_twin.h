/// shaders/light/bsdf.glsl and lang/sobol.glsl compiled as C++, with every lobe there.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>

namespace splatray::testing {

/// What a surface is made of, as Bsdf in shaders/light/bsdf.glsl has it.
struct TwinSurface {
  glm::vec3 base{1.0F};
  float metallic = 0.0F;
  glm::vec3 f0{0.0F};
  float f90 = 0.0F;
  float alpha = 1.0F;
  float transmission = 0.0F;
  float eta = 1.0F;
  float coat = 0.0F;
  float coat_alpha = 0.0F;
};

struct TwinValue {
  glm::vec3 value{0.0F};  ///< times |cosine|
  float pdf = 0.0F;
};
struct TwinSample {
  glm::vec3 dir{0.0F}, weight{0.0F};
  float pdf = 0.0F;
  bool delta = false, transmitted = false;
};

[[nodiscard]] TwinValue twin_bsdf_value(const TwinSurface& surface, const glm::vec3& to_eye,
                                        const glm::vec3& to_light);
[[nodiscard]] TwinSample twin_bsdf_sample(const TwinSurface& surface, const glm::vec3& to_eye,
                                          const glm::vec3& random);
[[nodiscard]] glm::vec4 twin_sobol_sample(std::uint32_t pixel, std::uint32_t sample, std::uint32_t group,
                                          std::uint32_t seed);

}  // namespace splatray::testing
