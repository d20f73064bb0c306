/// A look at VTK's legacy files before VTK reads them.
#pragma once
#include <filesystem>

#include "preprocess/read/read_listener.h"

namespace splatray {

/// VTK asks for memory as a .vtk file's numbers say, and its reader trusts the cells of older files; this pass goes through the
/// file as "VTK File Formats" (Kitware, versions 1.0 to 5.1) describes it and makes sure that each array ends within the file and
/// that cells fit their list. It knows no arrays of texts, no tables, graphs and trees.
/// Throws Error (input_unreadable) with found and expected.
void check_vtk_legacy(const std::filesystem::path& path, const ReadListener& listener);

}  // namespace splatray
