/// The compiled programs, SPIR-V words: the rows of variants.cmake. Made at build time.
#pragma once
#include <cstdint>
#include <span>

namespace splatray {

extern const std::span<const std::uint32_t> TRACE, TRACE_PAGED, TRACE_CPU, TRACE_CPU_PAGED;
extern const std::span<const std::uint32_t> LIGHT, LIGHT_PAGED, LIGHT_CPU, LIGHT_CPU_PAGED;
extern const std::span<const std::uint32_t> RAYS, RAYS_PAGED, RAYS_CPU, RAYS_CPU_PAGED;
extern const std::span<const std::uint32_t> EMPTY_CPU, EMPTY_LIGHT_CPU;

}  // namespace splatray
