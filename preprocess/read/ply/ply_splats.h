/// PLY files of splats, as preprocess/write/write_points.h has them.
#pragma once
#include "preprocess/points.h"
#include "preprocess/read/ply/ply_header.h"

namespace splatray {

/// Whether the file says that its points are splats.
[[nodiscard]] bool has_splats(const PlyHeader& header);

/// Takes what the header's comments say: of any file its coordinate system ("crs TEXT"); of splats the lattice, the up direction
/// and scans, with the words of normal fields and clip lines, which are no columns then.
void take_remarks(const PlyHeader& header, Points& points);

}  // namespace splatray
