/// VTP through VTK. VTK believes what a file says, so each file is checked first. Nothing is printed.
#pragma once
#include <filesystem>

#include "preprocess/points.h"
#include "preprocess/read/read_listener.h"

namespace splatray {

/// VTP: positions in the file's precision; point data Normals, 3 or 4 component uchar scalars (sRGB colours) and an array
/// `radius`. Throws Error (input_unreadable), (interrupted).
[[nodiscard]] Mesh read_vtp(const std::filesystem::path& path, const ReadListener& listener);

}  // namespace splatray
