/// The engine's compute programs.
#pragma once
#include <cstdint>
#include <span>

#include "engine/device/device_profile.h"

namespace splatray {

enum class Program {
  trace,        ///< trace.comp.glsl: a tile of an image, or what its centre rays hit
  empty,        ///< empty.comp.glsl: the same where no primary ray hits anything
  light,        ///< trace.comp.glsl, path tracing and its like (LOOK_*)
  empty_light,  ///< empty.comp.glsl for it
  rays,         ///< rays.comp.glsl: ray queries
};

/// SPIR-V of a program (shaders/variants.cmake); `paged`: some pool is in several buffers.
[[nodiscard]] std::span<const std::uint32_t> program_code(Program program, Kernels kernels, bool paged);

}  // namespace splatray
