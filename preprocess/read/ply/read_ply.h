/// PLY: points or triangles, ASCII and binary of both endians.
#pragma once
#include <filesystem>

#include "preprocess/points.h"
#include "preprocess/read/read_listener.h"

namespace splatray {

/// Reads a PLY file in blocks. Vertex properties: x y z (any type; float64 kept), nx ny nz, red green blue
/// (also r g b and diffuse_red ...; 8 or 16 bit or float, sRGB), radius. Of point
/// sets also attributes (read_ply_vertices), range grids and sensors' places (ply_scan.h). Captures of 3D Gaussians are
/// refused. Faces (vertex_indices or vertex_index, also `tristrips`) are triangulated as
/// fans. Everything else is skipped and named in a note. Throws Error (input_unreadable) with the line or
/// byte offset.
[[nodiscard]] Mesh read_ply(const std::filesystem::path& path, const ReadOptions& options,
                            const ReadListener& listener);

}  // namespace splatray
