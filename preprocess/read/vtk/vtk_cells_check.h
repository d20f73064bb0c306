/// A look at what VTK has read before its filters work on it.
#pragma once
#include <vtkDataSet.h>

#include <filesystem>

namespace splatray {

/// VTK's filters believe their input: makes sure that cells use points that are there and have as many as their type needs, and
/// that grids have as many points as their dimensions say. Throws Error (input_unreadable) with the file, found and expected.
void check_vtk_cells(vtkDataSet* data, const std::filesystem::path& path);

}  // namespace splatray
