/// The engine's compute programs, and one run of them.
#pragma once
#include <cstdint>

#include "engine/device/spec_constants.h"
#include "shaders/layout.h"

namespace splatray {

enum class Program {
  trace,  ///< trace.comp.glsl: a tile of an image, or what its centre rays hit
  light,  ///< trace.comp.glsl, path tracing and its like (LOOK_*)
  rays,   ///< rays.comp.glsl: ray queries
};

/// Which program, with which constants and parameters, over how many groups.
struct Dispatch {
  Program program = Program::trace;
  SpecConstants constants{};
  FrameParams frame{};
  std::uint32_t groups_x = 1;
  std::uint32_t groups_y = 1;

  /// Sets the numbers of groups so that there are at least `count`; none for 0.
  void set_groups(std::uint32_t count);
  [[nodiscard]] bool counts_work() const { return has(constants, FEATURE_COUNTERS); }
};

/// Groups of `group` threads that hold `threads`.
[[nodiscard]] std::uint32_t groups(std::uint32_t threads, std::uint32_t group);

}  // namespace splatray
