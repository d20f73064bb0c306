/// The packets of one scan's binary section (ASTM E2807-11, section 9.4).
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "preprocess/read/e57/paged_file.h"

namespace splatray {

/// Where the packets of one scan lie, in content's offsets.
struct E57Section {
  std::uint64_t begin = 0;  ///< of the first packet
  std::uint64_t end = 0;    ///< behind the last, at most the file's size
};

/// Bytes of each field of a record, in the prototype's order.
using FieldBytes = std::vector<std::span<const unsigned char>>;

/// Reads the section's header at `header_offset`. The section is empty where the file is cut off before it and where it
/// has no packets (records of constants need none). Throws Error
/// (input_unreadable) where there is none.
[[nodiscard]] E57Section read_section_header(PagedFile& file, std::uint64_t header_offset);

/// Goes through the data packets of a section; index packets and ignored ones are passed over.
class PacketReader {
 public:
  /// Goes to the section's begin. `field_count`: streams of each packet.
  PacketReader(PagedFile& file, const E57Section& section, std::size_t field_count);

  /// The next packet's streams, valid until the next call; false at the section's end or where the file ends in a packet.
  /// Throws Error (input_unreadable) for a packet that is none.
  [[nodiscard]] bool next(FieldBytes& streams);

 private:
  [[noreturn]] void fail(const std::string& what) const;
  void split(const unsigned char* packet, std::size_t size, FieldBytes& streams) const;

  PagedFile& file_;
  std::uint64_t end_;
  std::size_t field_count_;
};

}  // namespace splatray
