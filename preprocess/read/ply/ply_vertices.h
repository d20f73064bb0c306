/// The vertex element of a PLY file.
#pragma once
#include <string>
#include <vector>

#include "preprocess/points.h"
#include "preprocess/read/ply/ply_body.h"

namespace splatray {

/// Reads the vertices that there are, which may be less than the element declares; `in` stands on the first. Skipped properties and guesses about colours go to `notes`. Of a point
/// set, properties that are known attributes (known_columns), confidence and those of `attributes` become columns; a scan's
/// number makes stations too. `attributes` is null where the vertices are a mesh's, which has no columns.
[[nodiscard]] Points read_ply_vertices(PlyBody& in, const PlyElement& element,
                                       const std::vector<std::string>* attributes,
                                       std::vector<std::string>& notes);

}  // namespace splatray
