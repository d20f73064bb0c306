/// The engine's programs, and where their code comes from.
#pragma once
#include <cstdint>
#include <span>

#include "engine/gpu/pools.h"
#include "engine/vulkan/context.h"

namespace splatray {

/// The engine's shaders.
enum class Program {
  trace,   ///< trace.comp.glsl: a tile of a picture
  staged,  ///< ... in stages (queue.glsl)
  empty,   ///< ... where no primary ray hits anything (empty.glsl)
  rays,    ///< rays.comp.glsl: ray queries
};

/// SPIR-V of one program, in all its variants.
struct ProgramVariants {
  std::span<const std::uint32_t> storage, texel, storage_float64, texel_float64;

  [[nodiscard]] std::span<const std::uint32_t> get(PoolAccess access, Arithmetic arithmetic) const {
    const bool is_texel = access == PoolAccess::texel;
    if (arithmetic == Arithmetic::float64) return is_texel ? texel_float64 : storage_float64;
    return is_texel ? texel : storage;
  }
};

/// SPIR-V of a program for pools that are read this way (texel or storage), some `paged` or none, and hits decided by this
/// arithmetic (double_float or float64).
using ProgramCode = std::span<const std::uint32_t> (*)(Program program, PoolAccess access, bool paged,
                                                       Arithmetic arithmetic);

/// That of shaders/.
[[nodiscard]] std::span<const std::uint32_t> engine_code(Program program, PoolAccess access, bool paged,
                                                         Arithmetic arithmetic);

}  // namespace splatray
