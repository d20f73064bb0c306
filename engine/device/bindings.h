/// How many bindings the programs have (shaders/layout.h), of which kind.
#pragma once
#include <cstdint>

#include "shaders/layout.h"

namespace splatray {

inline constexpr std::uint32_t BINDINGS = BIND_POOLS + POOLS;
/// Whether a binding is a pool's.
[[nodiscard]] constexpr bool is_pool(std::uint32_t binding) { return binding >= BIND_POOLS; }
/// Storage buffers of a program beside the pools: all but the environment.
inline constexpr std::uint32_t OTHER_STORAGE_BUFFERS = BINDINGS - POOLS - 1;

}  // namespace splatray
