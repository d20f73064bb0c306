// libFuzzer's entry into one target; FUZZ_TARGET names it.
#include <cstddef>

#include "tests/fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  splatray::testing::FUZZ_TARGET({data, size});
  return 0;
}
