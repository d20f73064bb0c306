#include "engine/cpu/wide/wide_step.h"
//
#include "engine/cpu/wide/wide_blend.h"
//
#include "engine/cpu/wide/wide_gather.h"

namespace splatray {

extern const WideFunctions WIDE_AVX512;
const WideFunctions WIDE_AVX512{step, blend, open_tile, step_tile};

}  // namespace splatray
