#include "engine/cpu/picture_kernel.h"

namespace splatray {

void run_trace_kernel(const KernelWork& work, std::uint32_t group, Counts& counts) {
  run_pictures(work, group, counts);
}

}  // namespace splatray
