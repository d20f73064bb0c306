/// One geometry file of any supported kind.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "preprocess/points.h"

namespace splatray {

/// Reads .ply .obj .stl or .vtp (any case); a mesh without triangles is a point set.
/// Throws Error (input_unreadable); an unknown extension is told with those supported.
[[nodiscard]] Mesh read_mesh(const std::filesystem::path& path, std::vector<std::string>& notes);

}  // namespace splatray
