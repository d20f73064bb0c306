#include "engine/device/vulkan/program_code.h"

#include "shaders/spirv.h"

namespace splatray {

std::span<const std::uint32_t> program_code(Program program) {
  switch (program) {
    case Program::light:
      return LIGHT;
    case Program::rays:
      return RAYS;
    default:
      return TRACE;
  }
}

}  // namespace splatray
