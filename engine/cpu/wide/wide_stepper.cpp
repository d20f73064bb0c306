#include "engine/cpu/wide/wide_walk.h"

namespace splatray {

WideStep wide_step_base(const WideView& tree, WideWalk& walk);
#ifdef __x86_64__
WideStep wide_step_sse(const WideView& tree, WideWalk& walk);
WideStep wide_step_avx2(const WideView& tree, WideWalk& walk);
WideStep wide_step_avx512(const WideView& tree, WideWalk& walk);
#endif

WideStepper wide_stepper() {
#ifdef __x86_64__
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                    __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("aes") &&
                    __builtin_cpu_supports("pclmul");
  const bool avx512 = avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                      __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
                      __builtin_cpu_supports("avx512vl");
  if (avx512) return wide_step_avx512;
  if (avx2) return wide_step_avx2;
  if (__builtin_cpu_supports("sse4.2")) return wide_step_sse;
#endif
  return wide_step_base;
}

}  // namespace splatray
