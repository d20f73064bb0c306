/// A look at VTK's XML files before VTK reads them.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "preprocess/read/read_listener.h"

namespace splatray {

/// VTK asks for memory as a file's numbers say (.vtp, .vtu, .pvtp, .pvtu); this pass makes sure that they fit the file's size:
/// counts of points, cells and tuples are at most one for each byte of the file (16 where it is compressed), arrays end within
/// the file, and compressed blocks are not empty and grow by no more than zlib can (1032). Elements nest at most 64 deep, arrays have a type that VTK knows,
/// and there is no document type. Returns the files that its pieces name, as written. Throws Error (input_unreadable) with found and expected.
[[nodiscard]] std::vector<std::string> check_vtk_xml(const std::filesystem::path& path,
                                                     const ReadListener& listener);

}  // namespace splatray
