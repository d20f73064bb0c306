#include "engine/device/vulkan/program_code.h"

#include "shaders/spirv.h"

namespace splatray {

std::span<const std::uint32_t> program_code(Program program, Kernels kernels, bool paged) {
  const bool cpu = kernels == Kernels::cpu;
  switch (program) {
    case Program::empty:
      return EMPTY_CPU;
    case Program::empty_light:
      return EMPTY_LIGHT_CPU;
    case Program::light:
      return cpu ? (paged ? LIGHT_CPU_PAGED : LIGHT_CPU) : (paged ? LIGHT_PAGED : LIGHT);
    case Program::rays:
      return cpu ? (paged ? RAYS_CPU_PAGED : RAYS_CPU) : (paged ? RAYS_PAGED : RAYS);
    default:
      return cpu ? (paged ? TRACE_CPU_PAGED : TRACE_CPU) : (paged ? TRACE_PAGED : TRACE);
  }
}

}  // namespace splatray
