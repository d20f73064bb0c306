/// Memory that stages of the build ask for before they take it: midway it cannot be refused.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>

#include "engine/base/memory.h"

namespace splatray {

/// Throws Error (out_of_memory) unless there are `bytes` and, where they are many, what threads and allocators take for
/// themselves.
inline void require_room(std::uint64_t bytes, const std::string& what) {
  constexpr std::uint64_t SPARE = std::uint64_t{8} << 20U;
  require_memory(bytes > SPARE / 2 ? bytes + SPARE : bytes, what);
}

/// The same of a stage that takes them at once.
inline void require_stage_memory(const char* stage, std::size_t count, std::uint64_t bytes_each) {
  require_room(count * bytes_each, "the stage '" + std::string(stage) + "' of the build");
}

}  // namespace splatray
