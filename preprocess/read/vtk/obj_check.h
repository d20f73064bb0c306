/// A look at an OBJ file before VTK reads it.
#pragma once
#include <filesystem>

#include "preprocess/read/read_listener.h"

namespace splatray {

/// What VTK's reader leaves out of an OBJ file.
struct ObjCheck {
  bool has_vertex_colors = false;  ///< some `v` line has six numbers or more
};

/// VTK's OBJ reader trusts every index; this pass makes sure of them. Checks that each `v` line has three
/// numbers and that all indices of `f`, `l` and `p` lines name vertices, texture coordinates and normals the
/// file has. Throws Error (input_unreadable) with the line.
[[nodiscard]] ObjCheck check_obj(const std::filesystem::path& path, const ReadListener& listener);

}  // namespace splatray
