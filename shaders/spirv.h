/// The compiled programs, one per shader and per way of reading the pools. Made at build time
/// (CMakeLists.txt).
#pragma once
#include <cstdint>
#include <span>

namespace splatray {

extern const std::span<const std::uint32_t> TRACE_STORAGE;  ///< trace.comp.glsl, pools in storage buffers
extern const std::span<const std::uint32_t> TRACE_TEXEL;  ///< trace.comp.glsl, pools in uniform texel buffers
extern const std::span<const std::uint32_t> RAYS_STORAGE;  ///< rays.comp.glsl, pools in storage buffers
extern const std::span<const std::uint32_t> RAYS_TEXEL;    ///< rays.comp.glsl, pools in uniform texel buffers

}  // namespace splatray
