// libFuzzer's entry into one target of the table, which the variable SPLATRAY_FUZZ_TARGET names: a variable, as libFuzzer
// starts this program again with its own arguments to merge a corpus.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <iterator>

#include "tests/fuzz/targets.h"

namespace {

using namespace splatray::testing;

const FuzzTarget* target = nullptr;

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  const char* name = std::getenv("SPLATRAY_FUZZ_TARGET");
  target = std::find_if(std::begin(FUZZ_TARGETS), std::end(FUZZ_TARGETS),
                        [&](const FuzzTarget& one) { return name != nullptr && one.name == name; });
  if (target != std::end(FUZZ_TARGETS)) return 0;
  for (const FuzzTarget& one : FUZZ_TARGETS) std::printf("%s\n", one.name.data());
  std::exit(name == nullptr ? 0 : 2);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  target->run({data, size});
  return 0;
}
