#include "preprocess/read/las/laz/laz_chunks.h"

#include <algorithm>
#include <memory>

#include "preprocess/base/little_endian.h"
#include "preprocess/read/las/laz/integer_decoder.h"
#include "preprocess/read/las/laz/laz_decoder.h"

namespace splatray {
namespace {

constexpr std::size_t POINTER_BYTES = 8;
constexpr std::size_t TABLE_HEAD_BYTES = 8;  ///< of the table: a version and the count of chunks

/// Where the table is said to lie. A program that cannot go back writes -1 and the place at the file's end.
std::uint64_t table_offset(ByteReader& in, const LasHeader& header) {
  in.seek(header.points_offset);
  const unsigned char* bytes = in.take(POINTER_BYTES);
  if (bytes == nullptr) return 0;
  const auto offset = load<std::uint64_t>(bytes);
  if (offset != ~std::uint64_t{0}) return offset;
  in.seek(in.offset() + in.remaining() - POINTER_BYTES);
  bytes = in.take(POINTER_BYTES);
  return bytes == nullptr ? 0 : load<std::uint64_t>(bytes);
}

/// The table's chunks, in a row from `begin` on; of equal chunks with `layout.chunk_points` each.
std::optional<std::vector<LazChunk>> read_table(ByteReader& in, const LazLayout& layout, std::uint64_t begin,
                                                std::uint64_t table) {
  constexpr std::uint64_t MOST_ENTRY_BYTES = 24;  ///< two numbers, coded as badly as can be
  if (table < begin || in.offset() + in.remaining() < TABLE_HEAD_BYTES ||
      table > in.offset() + in.remaining() - TABLE_HEAD_BYTES)
    return std::nullopt;
  in.seek(table);
  const unsigned char* head = in.take(TABLE_HEAD_BYTES);
  if (head == nullptr || load<std::uint32_t>(head) != 0) return std::nullopt;
  const auto count = load<std::uint32_t>(head + 4);
  if (count > (table - begin) / layout.record_bytes) return std::nullopt;
  const std::vector<unsigned char> bytes = in.read(MOST_ENTRY_BYTES * (std::uint64_t{count} + 1));
  ArithmeticDecoder decoder;
  decoder.start(bytes);
  const auto numbers = std::make_unique<IntegerDecoder<32, 2>>();
  numbers->reset();
  std::vector<LazChunk> chunks(count);
  LazChunk last{begin, 0, 0, false};
  for (LazChunk& chunk : chunks) {
    chunk.offset = last.offset + last.bytes;
    chunk.points =
        layout.has_equal_chunks
            ? layout.chunk_points
            : static_cast<std::uint32_t>(numbers->read(decoder, static_cast<std::int32_t>(last.points), 0));
    chunk.bytes =
        static_cast<std::uint32_t>(numbers->read(decoder, static_cast<std::int32_t>(last.bytes), 1));
    if (decoder.is_damaged() || chunk.bytes > table - chunk.offset) return std::nullopt;
    last = chunk;
  }
  return chunks;
}

/// Layered chunks by what each says of itself, as far as the file goes.
std::vector<LazChunk> walk_layered(ByteReader& in, const LazLayout& layout, std::uint64_t begin,
                                   std::uint64_t points) {
  std::vector<LazChunk> chunks;
  const std::size_t head_bytes = layered_head_bytes(layout);
  for (std::uint64_t offset = begin; points > 0;) {
    in.seek(offset);
    const std::vector<unsigned char> head = in.read(head_bytes);
    if (head.size() < head_bytes) break;
    const LayeredChunk chunk = layered_chunk(layout, head.data());
    if (chunk.points == 0 || chunk.bytes > head_bytes + in.remaining()) break;
    chunks.push_back({offset, chunk.bytes, std::min<std::uint64_t>(chunk.points, points), false});
    offset += chunk.bytes;
    points -= chunks.back().points;
    chunks.back().is_last = points == 0;
  }
  return chunks;
}

}  // namespace

std::uint64_t first_laz_chunk(const LasHeader& header, const LazLayout& layout) {
  return header.points_offset + (layout.is_chunked ? POINTER_BYTES : 0);
}

std::optional<std::vector<LazChunk>> find_laz_chunks(ByteReader& in, const LasHeader& header,
                                                     const LazLayout& layout) {
  if (!layout.is_chunked) return std::nullopt;
  const std::uint64_t begin = first_laz_chunk(header, layout);
  in.seek(0);
  if (begin > in.remaining()) return std::nullopt;
  std::optional<std::vector<LazChunk>> chunks = read_table(in, layout, begin, table_offset(in, header));
  if (!chunks && layout.is_layered) return walk_layered(in, layout, begin, header.point_count);
  if (!chunks) return std::nullopt;
  std::uint64_t left = header.point_count;
  for (LazChunk& chunk : *chunks) {
    chunk.points = std::min(chunk.points, left);
    left -= chunk.points;
  }
  std::erase_if(*chunks, [](const LazChunk& chunk) { return chunk.points == 0; });
  if (!chunks->empty()) chunks->back().is_last = true;
  return chunks;
}

}  // namespace splatray
