/// What is compiled for several kinds of CPUs.
#pragma once
#include "engine/cpu/wide/wide_light.h"
#include "engine/cpu/wide/wide_tile.h"
#include "engine/cpu/wide/wide_walk.h"

namespace splatray {

/// The functions for one kind of CPU.
struct WideFunctions {
  WideStepper step;
  WideBlender blend;
  WideOpener open_tile;
  WideTileStepper step_tile;
  WideSampler sample;
  WideScatterer scatter;
  WideEscaper escape;
};

/// The fastest that this CPU runs, of vectors of at most `vector_bits`: 512, 256 and 128 on x86-64, else those of any CPU that
/// the compiler is asked for. All give the same bits.
[[nodiscard]] const WideFunctions& wide_functions(std::uint32_t vector_bits);

}  // namespace splatray
