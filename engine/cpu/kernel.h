/// The programs as C++, for machines without Vulkan: the shaders' own text, compiled by the host's compiler.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/cpu/wide/wide_functions.h"
#include "engine/device/bindings.h"
#include "engine/device/spec_constants.h"
#include "shaders/layout.h"

namespace splatray {

using Counts = std::array<std::uint32_t, COUNTER_COUNT>;

/// What the groups of one dispatch read and write.
struct KernelWork {
  SpecConstants constants{};
  FrameParams frame{};
  std::array<std::byte*, BINDINGS> bound{};  ///< arrays in host memory, by BIND_*; pools in one page
  WideView tree;                             ///< over the splats
  /// Where arrays end: a file that is traced where it is mapped may be changed by someone, and is refused after that.
  std::uint32_t last_splat = 0, last_material = 0;
  WideFunctions functions{};            ///< of this CPU
  std::uint32_t environment_width = 1;  ///< texels, vec4, at BIND_ENVIRONMENT
  std::uint32_t environment_height = 1;
};

/// What the wide functions read of a dispatch of light.
[[nodiscard]] WideLight wide_light_of(const KernelWork& work);

/// Runs the threads of the group of this number, one after the other; adds what they count to `counts`.
using Kernel = void (*)(const KernelWork& work, std::uint32_t group, Counts& counts);

/// Those of Program's names.
void run_trace_kernel(const KernelWork& work, std::uint32_t group, Counts& counts);
void run_light_kernel(const KernelWork& work, std::uint32_t group, Counts& counts);
void run_rays_kernel(const KernelWork& work, std::uint32_t group, Counts& counts);

}  // namespace splatray
