/// The host's CPU as a device that runs a kernel's groups.
#pragma once
#include <array>
#include <cstdint>

#include "engine/cpu/kernel.h"

namespace splatray {

/// Runs groups 0 .. count - 1 on `threads` threads, 0 = one a core, each group on one, and adds what they count to `counts`.
void run_groups(Kernel kernel, const KernelWork& work, std::uint32_t count, unsigned threads,
                std::array<std::uint64_t, COUNTER_COUNT>& counts);

}  // namespace splatray
