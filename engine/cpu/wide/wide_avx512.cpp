#define WIDE_STEP wide_step_avx512
#include "engine/cpu/wide/wide_step.h"
