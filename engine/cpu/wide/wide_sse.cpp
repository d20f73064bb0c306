#define WIDE_STEP wide_step_sse
#include "engine/cpu/wide/wide_step.h"
