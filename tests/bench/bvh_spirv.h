/// The programs of shaders/ with the traversal of bvh.glsl, for nodes of 4 and of 8 children; made at build time
/// (CMakeLists.txt).
#pragma once
#include <cstdint>
#include <span>

namespace splatray {

extern const std::span<const std::uint32_t> BVH4_TRACE_STORAGE, BVH4_TRACE_TEXEL, BVH4_TRACE_STORAGE_FLOAT64,
    BVH4_TRACE_TEXEL_FLOAT64, BVH4_RAYS_STORAGE, BVH4_RAYS_TEXEL, BVH4_RAYS_STORAGE_FLOAT64,
    BVH4_RAYS_TEXEL_FLOAT64;
extern const std::span<const std::uint32_t> BVH8_TRACE_STORAGE, BVH8_TRACE_TEXEL, BVH8_TRACE_STORAGE_FLOAT64,
    BVH8_TRACE_TEXEL_FLOAT64, BVH8_RAYS_STORAGE, BVH8_RAYS_TEXEL, BVH8_RAYS_STORAGE_FLOAT64,
    BVH8_RAYS_TEXEL_FLOAT64;

}  // namespace splatray
