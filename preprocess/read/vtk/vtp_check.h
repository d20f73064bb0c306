/// A look at a VTP file before VTK reads it.
#pragma once
#include <filesystem>

#include "preprocess/read/read_listener.h"

namespace splatray {

/// VTK asks for memory as a VTP file's numbers say; this pass makes sure that they fit the file's size: counts of points,
/// cells and tuples are at most one for each byte of the file (16 where it is compressed), arrays end within the file, and
/// compressed blocks grow by no more than zlib can (1032). Elements nest at most 64 deep, and there is no document type.
/// Throws Error (input_unreadable) with found and expected.
void check_vtp(const std::filesystem::path& path, const ReadListener& listener);

}  // namespace splatray
