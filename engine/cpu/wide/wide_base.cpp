#define WIDE_STEP wide_step_base
#include "engine/cpu/wide/wide_step.h"
