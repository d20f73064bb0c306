/// SPIR-V of the engine's programs.
#pragma once
#include <cstdint>
#include <span>

#include "engine/device/program.h"

namespace splatray {

/// That of a program (shaders/variants.cmake).
[[nodiscard]] std::span<const std::uint32_t> program_code(Program program);

}  // namespace splatray
