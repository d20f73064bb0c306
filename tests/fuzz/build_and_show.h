/// What lies behind the readers: the whole preprocess, and a picture.
#pragma once
#include "preprocess/points.h"

namespace splatray::testing {

/// Builds the scene of an input, with parameters that follow from `choice`, and renders 8 x 8 pixels of it on the CPU device; pixels
/// must be finite, the octree's pools as scene files demand. Throws Error (input_unreadable) where no point is left.
void build_and_show(Input input, std::uint64_t choice);

}  // namespace splatray::testing
