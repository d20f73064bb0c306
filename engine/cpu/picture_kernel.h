/// The kernels of pictures: with LIT path tracing, else Phong. For trace_kernel.cpp and light_kernel.cpp, which name them.
#pragma once
#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <utility>
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
#include "stage/trace.glsl"
//
#include "engine/cpu/wide_trace.h"
//
#include "engine/cpu/wide_shadow.h"
//
#include "engine/cpu/picture_tile.h"
#ifdef LIT
//
#include "engine/cpu/wave.h"
#endif

void run_pictures(const KernelWork& work, std::uint32_t group, Counts& counts) {
#ifdef LIT
  bound = &work;
  if (runs_in_waves()) return run_wave(work, group, counts);
#endif
  bool opened = false;
  run_group(work, group, counts, [&] {
    uvec2 in_tile(0);
    if (!find_pixel(in_tile)) return;
    if (!std::exchange(opened, true)) tile_now = open_group_tile();
    slot_now = tile_slot();
#ifndef LIT
    if (show_background(in_tile)) return;
#endif
    trace_pixel(in_tile);
  });
  tile_now = nullptr;
}

}  // namespace
}  // namespace splatray
