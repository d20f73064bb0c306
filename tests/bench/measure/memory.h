/// Memory of this machine.
#pragma once
#include <cstdint>
#include <fstream>
#include <limits>
#include <string>

namespace splatray::testing {

/// Bytes that programs can still get without swapping, from Linux; elsewhere as much as there can be.
[[nodiscard]] inline std::uint64_t available_memory_bytes() {
  std::ifstream stream("/proc/meminfo");
  std::string word;
  while (stream >> word)
    if (std::uint64_t kibibytes = 0; word == "MemAvailable:" && stream >> kibibytes) return kibibytes << 10U;
  return std::numeric_limits<std::uint64_t>::max();
}

/// Why a job that takes `bytes` is left out, as a phrase; empty when there is room.
[[nodiscard]] inline std::string reason_of_memory(std::uint64_t bytes) {
  const std::uint64_t available = available_memory_bytes();
  if (bytes <= available) return "";
  return "it takes " + std::to_string(bytes >> 20U) + " MiB of memory and " +
         std::to_string(available >> 20U) + " are free";
}

}  // namespace splatray::testing
