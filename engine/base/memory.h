/// How much memory there is, asked before much of it is used: where it runs out the kernel kills, and says nothing.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

#include "engine/base/progress.h"

namespace splatray {

/// Bytes that this process may still use: the least of what the machine has (MemAvailable and free swap), what its control
/// groups leave it (versions 1 and 2; the cache of files in them can be taken back) and what is left of RLIMIT_AS. UINT64_MAX
/// where nothing is known. `root`: where /proc and /sys are looked for.
[[nodiscard]] std::uint64_t available_memory(const std::filesystem::path& root = "/");

/// Throws Error (out_of_memory), a sentence with the two sizes, unless `bytes` are available or free within this process;
/// `what` needs them, such as "a picture of 640x480 pixels".
void require_memory(std::uint64_t bytes, const std::string& what);

/// `progress`, which may be empty, as one that also looks some times a second how much memory there is, and throws Error
/// (out_of_memory) where that comes to an end: for work whose needs are not known beforehand.
[[nodiscard]] Progress watching_memory(Progress progress, const std::filesystem::path& root = "/");

}  // namespace splatray
