/// STL, binary and ASCII.
#pragma once
#include <filesystem>

#include "preprocess/points.h"
#include "preprocess/read/read_listener.h"

namespace splatray {

/// Reads triangles; equal corners become one vertex, triangles with two equal corners are left out. Positions are float32,
/// as the format has them, which is noted where it shows; facets' normals are not looked at. Triangles of a binary file behind those that it counts are read,
/// with a note; attributes are not, with another. Throws Error
/// (input_unreadable), (interrupted).
[[nodiscard]] Mesh read_stl(const std::filesystem::path& path, const ReadListener& listener);

}  // namespace splatray
