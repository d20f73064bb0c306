/// Wavefront OBJ (B1 of Wavefront's Advanced Visualizer manual, 1993): vertices, normals, faces.
#pragma once
#include <filesystem>

#include "preprocess/points.h"
#include "preprocess/read/read_listener.h"

namespace splatray {

/// All faces as one mesh, or without faces its vertices as points. Polygons become fans. Positions are float64; six numbers of
/// a vertex are its place and its display-encoded colour, of 0..1 or, where one is above 1, of 0..255. Lines, texture
/// coordinates and materials are not read, but their indices are checked, and a note names lines and materials. Throws Error (input_unreadable) with the line,
/// (interrupted).
[[nodiscard]] Mesh read_obj(const std::filesystem::path& path, const ReadListener& listener);

}  // namespace splatray
