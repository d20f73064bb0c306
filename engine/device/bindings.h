/// How many bindings the programs have (shaders/layout.h), of which kind.
#pragma once
#include <cstdint>

#include "shaders/layout.h"

namespace splatray {

inline constexpr std::uint32_t BINDINGS = BIND_POOLS + POOLS;
/// Whether a binding is a pool's.
[[nodiscard]] constexpr bool is_pool(std::uint32_t binding) { return binding >= BIND_POOLS; }
/// Whether a binding is read as the scene's pools are: in texel buffers or storage buffers.
[[nodiscard]] constexpr bool is_read_as_pools(std::uint32_t binding) { return binding >= BIND_LIGHT_TABLES; }
/// Most bindings of a program beside the pools: sampled images, the environment and the paths of stages among them, and
/// the most storage buffers.
inline constexpr std::uint32_t OTHER_SAMPLED_IMAGES = 4;
inline constexpr std::uint32_t OTHER_STORAGE_BUFFERS = BINDINGS - POOLS - 2;

}  // namespace splatray
