/// The programs of shaders/ with the traversal of bvh.glsl, as in shaders/spirv.h; made at build time (CMakeLists.txt).
#pragma once
#include <cstdint>
#include <span>

namespace splatray {

extern const std::span<const std::uint32_t> BVH_TRACE_STORAGE, BVH_TRACE_TEXEL, BVH_TRACE_STORAGE_FLOAT64,
    BVH_TRACE_TEXEL_FLOAT64;
extern const std::span<const std::uint32_t> BVH_RAYS_STORAGE, BVH_RAYS_TEXEL, BVH_RAYS_STORAGE_FLOAT64,
    BVH_RAYS_TEXEL_FLOAT64;

}  // namespace splatray
