/// The scene file `.soct`: a header, a table of sections, the sections, an end marker. Little-endian. The array sections
/// are the GPU buffer images (shaders/layout.h).
///
/// (table: to be completed by whoever writes scene_file.cpp)
#pragma once
#include <filesystem>

#include "engine/host/scene.h"

namespace splatray {

inline constexpr std::uint32_t SCENE_FILE_VERSION = 1;

/// Writes to a temporary name beside `path`, then renames. Throws Error (failed) when it cannot; leaves nothing behind.
void write_scene(const Scene& scene, const std::filesystem::path& path);

/// Reads and checks a whole scene file. Refuses, as Error (input_unreadable) with path, found and expected: wrong magic,
/// newer version, foreign endianness, truncation at any byte, extra bytes, checksum mismatch, an address outside its pool,
/// a Begin-End that does not ascend, a splat that is not finite or names an object that does not exist, a non-finite transform.
[[nodiscard]] Scene read_scene(const std::filesystem::path& path);

}  // namespace splatray
