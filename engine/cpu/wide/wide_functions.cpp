#include "engine/cpu/wide/wide_functions.h"

namespace splatray {

extern const WideFunctions WIDE_BASE;
#ifdef __x86_64__
extern const WideFunctions WIDE_SSE, WIDE_AVX2, WIDE_AVX512;
#endif

const WideFunctions& wide_functions([[maybe_unused]] std::uint32_t vector_bits) {
#ifdef __x86_64__
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                    __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("aes") &&
                    __builtin_cpu_supports("pclmul");
  const bool avx512 = avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                      __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
                      __builtin_cpu_supports("avx512vl");
  if (avx512 && vector_bits >= 512) return WIDE_AVX512;
  if (avx2 && vector_bits >= 256) return WIDE_AVX2;
  if (__builtin_cpu_supports("sse4.2") && vector_bits >= 128) return WIDE_SSE;
#endif
  return WIDE_BASE;
}

}  // namespace splatray
