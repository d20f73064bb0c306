/// What a path does at a vertex and where it meets nothing, by the shaders' own text as C++, for comparison with the vectors of
/// engine/cpu/wide/wide_light.h.
#pragma once
#include "engine/cpu/kernel.h"

namespace splatray::testing {

/// As WideVertices have it of a vertex.
struct TwinVertex {
  glm::vec3 light_random, light_dir, radiance;
  float light_pdf;
  glm::vec3 value;
  float value_pdf;
  glm::vec3 next_dir, weight;
  float next_pdf, next_random;
};

/// As WideEscapes have it of a ray.
struct TwinEscape {
  glm::vec3 radiance;
  float pdf;
};

/// What vertex `i` becomes under the materials, tables and constants of a dispatch.
[[nodiscard]] TwinVertex twin_vertex(const KernelWork& work, const WideVertices& vertices, std::uint32_t i);
[[nodiscard]] TwinEscape twin_escape(const KernelWork& work, const glm::vec3& dir);

}  // namespace splatray::testing
