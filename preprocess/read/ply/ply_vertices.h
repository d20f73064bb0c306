/// The vertex element of a PLY file.
#pragma once
#include <string>
#include <vector>

#include "preprocess/points.h"
#include "preprocess/read/ply/ply_body.h"

namespace splatray {

/// Reads all vertices; `in` stands on the first. Skipped properties and guesses about colours go to `notes`.
[[nodiscard]] Points read_ply_vertices(PlyBody& in, const PlyElement& element,
                                       std::vector<std::string>& notes);

}  // namespace splatray
