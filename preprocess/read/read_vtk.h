/// OBJ, STL and VTP through VTK.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "preprocess/points.h"

namespace splatray {

/// Reads a surface or points by the file's extension (.obj .stl .vtp, any case). Positions keep the precision
/// VTK reads them in (VTP: the file's; OBJ, STL: float32, said in `notes` where it shows). VTP: point data
/// Normals, 3 or 4 component uchar scalars (sRGB colours) and an array `radius`. VTK's own OBJ reader drops
/// vertex colours: said too. Throws Error (input_unreadable); nothing is printed.
[[nodiscard]] Mesh read_vtk(const std::filesystem::path& path, std::vector<std::string>& notes);

}  // namespace splatray
