#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

#include "engine/cpu/kernel.h"
#include "engine/scene/splat.h"

namespace splatray {
namespace {

#include "shaders/lang/glsl_as_cpp.h"
//
#include "engine/cpu/bindings_as_cpp.h"
//
#include "stage/rays.glsl"
//
#include "engine/cpu/wide_trace.h"

}  // namespace

void run_rays_kernel(const KernelWork& work, std::uint32_t group, Counts& counts) {
  run_group(work, group, counts, [] {
    const uint index = group_now * GROUP_SIZE + lane_now;
    if (index < frame.tile_width) answer_ray(index);
  });
}

}  // namespace splatray
