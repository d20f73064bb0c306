/// Cloud optimised point clouds: LAZ files whose chunks are the nodes of an octree (Hobu, COPC specification 1.0, 2021).
#pragma once
#include <filesystem>
#include <vector>

#include "preprocess/base/levels.h"
#include "preprocess/read/las/las_header.h"
#include "preprocess/read/las/las_vlrs.h"
#include "preprocess/read/las/laz/laz_chunks.h"

namespace splatray {

/// The directory of a file; no nodes where it is none of these. Throws Error (input_unreadable) for directories that are damaged: pages
/// or points that lie beyond the file or are named twice, cubes that cannot be, nodes without a parent, more points than the header counts.
[[nodiscard]] Levels read_copc(ByteReader& in, const LasHeader& header, const LasVlrs& vlrs);

/// The levels of a file of LAS's; empty for those without any. Throws Error (input_unreadable) where it cannot be read.
[[nodiscard]] Levels copc_levels(const std::filesystem::path& path);

/// The chunks of nodes, in the file's order.
[[nodiscard]] std::vector<LazChunk> chunks_of(const Levels& levels, const std::vector<std::uint32_t>& nodes);

}  // namespace splatray
