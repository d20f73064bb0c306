#define WIDE_STEP wide_step_avx2
#include "engine/cpu/wide/wide_step.h"
