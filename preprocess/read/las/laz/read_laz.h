/// Points of LAS files that LASzip compressed.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "preprocess/points.h"
#include "preprocess/read/bytes/byte_reader.h"
#include "preprocess/read/las/las_columns.h"
#include "preprocess/read/las/las_header.h"
#include "preprocess/read/las/laz/laz_chunks.h"
#include "preprocess/read/read_listener.h"

namespace splatray {

/// Adds the points of all chunks that are whole to `columns`, in the file's order, and what was left out of them to `counts`; a whole
/// chunk may have fewer than the header counts. `record` is LASzip's. `chosen`: these chunks, ascending by their places, else all.
/// Chunks are decoded in parallel, some of them in memory at a time. Returns how many points were decoded, at most header.point_count. Throws Error (input_unreadable) for
/// compressors that are not known.
[[nodiscard]] std::uint64_t read_laz_points(ByteReader& in, const LasHeader& header,
                                            std::span<const unsigned char> record,
                                            const std::optional<std::vector<LazChunk>>& chosen,
                                            LasColumns& columns, ScanCounts& counts,
                                            const ReadListener& listener);

}  // namespace splatray
