#include "preprocess/read/e57/packet_reader.h"

#include <algorithm>
#include <cstring>
#include <string>

namespace splatray {
namespace {

constexpr std::size_t SECTION_HEADER_BYTES = 32;
constexpr unsigned char VECTOR_SECTION = 1;
constexpr std::size_t PACKET_PREFIX_BYTES = 4;  ///< type, flags, length - 1: the same in all packets
constexpr std::size_t DATA_HEADER_BYTES = 6;

enum PacketType : unsigned char { INDEX_PACKET = 0, DATA_PACKET = 1, IGNORED_PACKET = 2 };

std::size_t word16(const unsigned char* bytes) { return bytes[0] | std::size_t{bytes[1]} << 8U; }

std::uint64_t word64(const unsigned char* bytes) {
  std::uint64_t word = 0;
  std::memcpy(&word, bytes, sizeof word);
  return word;
}

}  // namespace

E57Section read_section_header(PagedFile& file, std::uint64_t header_offset) {
  const bool is_there = header_offset <= file.size() && file.size() - header_offset >= SECTION_HEADER_BYTES;
  if (!is_there && file.is_cut_off()) return {};
  if (!is_there)
    throw_unreadable(file.path(), "found points beyond the file's " + std::to_string(file.physical_size()) +
                                      " bytes, expected them within");
  file.seek(header_offset);
  const unsigned char* header = file.take(SECTION_HEADER_BYTES);
  if (header[0] != VECTOR_SECTION)
    throw_unreadable(file.path(),
                     "found a section of type " + std::to_string(header[0]) + ", expected points (1)");
  const std::uint64_t length = word64(header + 8);
  const std::uint64_t begin = file.content_offset(word64(header + 16), "the first packet");
  if (begin < header_offset) return {};  // libE57Format writes 0 where there are no packets
  return {begin, header_offset + std::min(length, file.size() - header_offset)};
}

PacketReader::PacketReader(PagedFile& file, const E57Section& section, std::size_t field_count)
    : file_(file), end_(section.begin < section.end ? section.end : 0), field_count_(field_count) {
  if (end_ > 0) file.seek(section.begin);
}

void PacketReader::fail(const std::string& what) const {
  throw_unreadable(file_.path(), "in a packet of points, found " + what);
}

bool PacketReader::next(FieldBytes& streams) {
  while (file_.offset() < end_) {
    unsigned char prefix[PACKET_PREFIX_BYTES];
    const unsigned char* bytes = file_.take(sizeof prefix);
    if (bytes == nullptr) return false;
    std::memcpy(prefix, bytes, sizeof prefix);
    const std::size_t size = word16(prefix + 2) + 1;
    if (prefix[0] > IGNORED_PACKET) fail("the type " + std::to_string(prefix[0]) + ", expected 0, 1 or 2");
    if (size < PACKET_PREFIX_BYTES)
      fail("a length of " + std::to_string(size) + " bytes, expected 4 or more");
    const unsigned char* rest = file_.take(size - PACKET_PREFIX_BYTES);
    if (rest == nullptr) return false;
    if (prefix[0] == DATA_PACKET) {
      split(rest, size - PACKET_PREFIX_BYTES, streams);
      return true;
    }
  }
  return false;
}

void PacketReader::split(const unsigned char* packet, std::size_t size, FieldBytes& streams) const {
  const std::size_t count = size < 2 ? 0 : word16(packet);
  if (count != field_count_)
    fail(std::to_string(count) + " streams, expected " + std::to_string(field_count_));
  std::size_t at = DATA_HEADER_BYTES - PACKET_PREFIX_BYTES + 2 * count;
  if (at > size) fail("its header beyond its end");
  const unsigned char* lengths = packet + DATA_HEADER_BYTES - PACKET_PREFIX_BYTES;
  streams.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t length = word16(lengths + 2 * i);
    if (length > size - at) fail("a stream beyond its end");
    streams[i] = {packet + at, length};
    at += length;
  }
}

}  // namespace splatray
