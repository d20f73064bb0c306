/// The compiled programs, SPIR-V words: the rows of variants.cmake. Made at build time.
#pragma once
#include <cstdint>
#include <span>

namespace splatray {

extern const std::span<const std::uint32_t> TRACE, LIGHT, RAYS, FUSED, DISPLAY, DENOISE;

}  // namespace splatray
