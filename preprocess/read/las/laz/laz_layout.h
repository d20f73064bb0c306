/// How LASzip divides a record and a file (M. Isenburg, LASzip VLR: "laszip encoded", 22204).
#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "preprocess/read/las/las_header.h"

namespace splatray {

/// A part of each record that is coded in its own way.
struct LazItem {
  enum class Kind : std::uint16_t {
    bytes = 0,
    point10 = 6,
    gps_time11 = 7,
    rgb12 = 8,
    wavepacket13 = 9,
    point14 = 10,
    rgb14 = 11,
    rgbnir14 = 12,
    wavepacket14 = 13,
    bytes14 = 14,
  };
  Kind kind = Kind::bytes;
  std::size_t size = 0;
  unsigned version = 0;
  std::size_t at = 0;  ///< bytes from the record's begin
};

struct LazLayout {
  bool is_layered = false;       ///< fields are coded apart, with their bytes after one another in a chunk
  bool is_chunked = false;       ///< chunks can be decoded each on its own; else all points are one
  bool has_equal_chunks = true;  ///< else the chunk table says how many points each has
  std::uint32_t chunk_points = 0;
  std::size_t record_bytes = 0;
  std::vector<LazItem> items;
};

/// Reads the record's content and checks that it fits the header. Throws Error (input_unreadable) otherwise, or where
/// compressor or versions are not known.
[[nodiscard]] LazLayout read_laz_layout(std::span<const unsigned char> record, const LasHeader& header,
                                        const std::filesystem::path& path);

}  // namespace splatray
