/// How many bindings the programs have (shaders/layout.h), of which kind.
#pragma once
#include <cstdint>

#include "shaders/layout.h"

namespace splatray {

inline constexpr std::uint32_t BINDINGS = BIND_PATHS_QUEUED + 1;
inline constexpr std::uint32_t POOLS = BIND_TOP_TABLE - BIND_NODE_POOL + 1;
/// Of a program's bindings, beside the pools: the environment and the paths of stages, and storage buffers.
inline constexpr std::uint32_t OTHER_SAMPLED_IMAGES = 2;
inline constexpr std::uint32_t OTHER_STORAGE_BUFFERS = BINDINGS - POOLS - OTHER_SAMPLED_IMAGES;

}  // namespace splatray
