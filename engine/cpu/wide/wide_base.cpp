#include "engine/cpu/wide/wide_step.h"
//
#include "engine/cpu/wide/wide_blend.h"

namespace splatray {

extern const WideFunctions WIDE_BASE;
const WideFunctions WIDE_BASE{step, blend};

}  // namespace splatray
