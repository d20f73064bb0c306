/// The compiled programs trace.comp.glsl and rays.comp.glsl: with the pools in storage buffers or in uniform texel buffers, each
/// pool in one of them or in pages, hits decided in double-float or in float64. Made at build time (CMakeLists.txt).
#pragma once
#include <cstdint>
#include <span>

namespace splatray {

extern const std::span<const std::uint32_t> TRACE_STORAGE, TRACE_TEXEL, TRACE_STORAGE_FLOAT64,
    TRACE_TEXEL_FLOAT64, TRACE_PAGED_STORAGE, TRACE_PAGED_TEXEL, TRACE_PAGED_STORAGE_FLOAT64,
    TRACE_PAGED_TEXEL_FLOAT64;
/// trace.comp.glsl in stages (queue.glsl).
extern const std::span<const std::uint32_t> STAGED_STORAGE, STAGED_TEXEL, STAGED_STORAGE_FLOAT64,
    STAGED_TEXEL_FLOAT64, STAGED_PAGED_STORAGE, STAGED_PAGED_TEXEL, STAGED_PAGED_STORAGE_FLOAT64,
    STAGED_PAGED_TEXEL_FLOAT64;
/// trace.comp.glsl where nothing is hit (empty.glsl).
extern const std::span<const std::uint32_t> EMPTY, EMPTY_FLOAT64;
extern const std::span<const std::uint32_t> RAYS_STORAGE, RAYS_TEXEL, RAYS_STORAGE_FLOAT64,
    RAYS_TEXEL_FLOAT64, RAYS_PAGED_STORAGE, RAYS_PAGED_TEXEL, RAYS_PAGED_STORAGE_FLOAT64,
    RAYS_PAGED_TEXEL_FLOAT64;

}  // namespace splatray
