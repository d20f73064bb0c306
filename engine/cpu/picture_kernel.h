/// The kernels of pictures: with LIT path tracing, else Phong. For trace_kernel.cpp and light_kernel.cpp, which name them.
#pragma once
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

#include "engine/cpu/kernel.h"
#include "engine/scene/splat.h"
#include "shaders/lang/albedo_layout.h"

namespace splatray {
namespace {

#include "shaders/lang/glsl_as_cpp.h"
//
#include "engine/cpu/bindings_as_cpp.h"
//
#include "stage/empty.glsl"
#include "stage/trace.glsl"
//
#include "engine/cpu/wide_trace.h"
//
#include "engine/cpu/wide_shadow.h"

void run_pictures(const KernelWork& work, std::uint32_t group, Counts& counts) {
  run_group(work, group, counts, [] {
    Work found{};
    if (find_work(found)) trace_work(found);
  });
}

void run_misses(const KernelWork& work, std::uint32_t group, Counts& counts) {
  run_group(work, group, counts, [] {
    uvec2 in_tile(0);
    if (find_pixel(in_tile)) miss_all(in_tile);
  });
}

}  // namespace
}  // namespace splatray
