/// Values that programs are compiled with.
#pragma once
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

}  // namespace splatray
