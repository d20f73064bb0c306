/// One geometry file of any supported kind.
#pragma once
#include <filesystem>

#include "preprocess/points.h"
#include "preprocess/read/read_listener.h"

namespace splatray {

/// Reads a file of a format that is one object (formats.h); a mesh without triangles is a point set.
/// Throws Error (input_unreadable); for an unknown extension its sentence lists those supported.
[[nodiscard]] Mesh read_mesh(const std::filesystem::path& path, const ReadOptions& options,
                             const ReadListener& listener);

}  // namespace splatray
