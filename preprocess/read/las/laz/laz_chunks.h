/// Where the chunks of a compressed LAS file lie.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "preprocess/read/bytes/byte_reader.h"
#include "preprocess/read/las/laz/laz_layout.h"

namespace splatray {

struct LazChunk {
  std::uint64_t offset = 0;  ///< from the file's begin
  std::uint64_t bytes = 0;
  std::uint64_t points = 0;
  bool is_last = false;  ///< the header may count fewer points than this one has, or more
};

/// The chunks that hold the points which the header counts, from the table behind them; of layered chunks also without one,
/// by what each says of itself, as far as the file goes. Nothing where that table is needed, and missing or no such table:
/// the program that wrote the file was stopped, or the file is cut off.
[[nodiscard]] std::optional<std::vector<LazChunk>> find_laz_chunks(ByteReader& in, const LasHeader& header,
                                                                   const LazLayout& layout);

/// Where the first chunk begins.
[[nodiscard]] std::uint64_t first_laz_chunk(const LasHeader& header, const LazLayout& layout);

}  // namespace splatray
