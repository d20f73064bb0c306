/// VTK's own formats, through VTK. VTK believes what a file says, so each file is checked first. Nothing is printed.
#pragma once
#include <filesystem>

#include "preprocess/points.h"
#include "preprocess/read/read_listener.h"

namespace splatray {

/// The surface of a .vtp, .vtu or legacy .vtk, or of the pieces that a .pvtp or .pvtu names, which lie beside it or below: faces,
/// the outer faces of volumes, or points where there are neither. Positions in the file's precision; point data Normals, 3 or 4
/// component uchar scalars (sRGB colours), an array `radius`; every other array of numbers at the points becomes a column, of
/// vectors NAME_X, NAME_Y, NAME_Z and NAME_Magnitude, of more components NAME_0 and so on. The field data of point sets that
/// preprocess/write wrote are read as their marks (splat_marks.h); other field data, values of cells and texts are named in a
/// note. Throws Error (input_unreadable), (interrupted).
[[nodiscard]] Mesh read_vtk(const std::filesystem::path& path, const ReadListener& listener);

}  // namespace splatray
