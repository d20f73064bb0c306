#include "engine/device/vulkan/program_code.h"

#include "shaders/spirv.h"

namespace splatray {

std::span<const std::uint32_t> program_code(Program program, bool paged) {
  switch (program) {
    case Program::light:
      return paged ? LIGHT_PAGED : LIGHT;
    case Program::rays:
      return paged ? RAYS_PAGED : RAYS;
    default:
      return paged ? TRACE_PAGED : TRACE;
  }
}

}  // namespace splatray
