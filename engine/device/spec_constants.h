/// Values that programs are compiled with.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>

#include "shaders/layout.h"

namespace splatray {

/// Values of the specialization constants; index = SPEC_*.
using SpecConstants = std::array<std::uint32_t, SPEC_COUNT>;

/// Whether constants have a feature, FEATURE_*.
[[nodiscard]] inline bool has(const SpecConstants& constants, std::uint32_t feature) {
  return (constants[SPEC_FEATURES] & feature) != 0;
}

/// Whether some pool is in several buffers.
[[nodiscard]] inline bool is_paged(const SpecConstants& constants) {
  return std::any_of(constants.begin() + SPEC_PAGES, constants.end(),
                     [](std::uint32_t more) { return more > 0; });
}

}  // namespace splatray
