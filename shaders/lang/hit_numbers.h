/// Numbers of tests and blends that the host's vectors (engine/cpu/wide) share with the shaders' text.
#ifndef SPLATRAY_HIT_NUMBERS_H
#define SPLATRAY_HIT_NUMBERS_H
#include "../layout.h"

#ifdef __cplusplus
#define SPLATRAY_FLOAT inline constexpr float
namespace splatray {
#else
#define SPLATRAY_FLOAT const float
#endif

/// Bound of the float32 error of n.(c - o) / |n| in lattice units, for origins at most a root's edge outside the root.
SPLATRAY_FLOAT PLANE_ERROR = 4.0f;

SPLATRAY_FLOAT WEIGHT_UNIT = 4194304.0f;    ///< 2^22: sums of weights are integers in this unit
SPLATRAY_FLOAT WEIGHT_LEAST = 0.00390625f;  ///< 2^-8: a lone hit at the rim still has a normal of 14 bits
SPLATRAY_FLOAT MIN_COSINE = 0.1f;           ///< the window grows as 1 / |n.d| up to this
SPLATRAY_CONST MEMBERS_MOST = 500u;  ///< further members do not count, so that the sums stay in 31 bits

#ifdef __cplusplus
}  // namespace splatray
#endif
#undef SPLATRAY_FLOAT
#endif
