#include "engine/cpu/wide/wide_step.h"
//
#include "engine/cpu/wide/wide_blend.h"
//
#include "engine/cpu/wide/wide_gather.h"
//
#include "engine/cpu/wide/wide_maths.h"
//
#include "engine/cpu/wide/wide_numbers.h"
//
#include "engine/cpu/wide/wide_sky.h"
//
#include "engine/cpu/wide/wide_bsdf.h"

namespace splatray {

extern const WideFunctions WIDE_BASE;
const WideFunctions WIDE_BASE{step, blend, open_tile, step_tile, sample, scatter, escape};

}  // namespace splatray
