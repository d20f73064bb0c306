#include "engine/cpu/wide/wide_step.h"
//
#include "engine/cpu/wide/wide_blend.h"

namespace splatray {

extern const WideFunctions WIDE_SSE;
const WideFunctions WIDE_SSE{step, blend};

}  // namespace splatray
