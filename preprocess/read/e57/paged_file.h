/// The pages of an E57 file (ASTM E2807-11, section 9.2): 1020 bytes of content and their CRC-32C each.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "preprocess/read/bytes/byte_reader.h"

namespace splatray {

/// What the first 48 bytes of an E57 file say (section 9.3). Physical offsets count checksums, as the file's own do.
struct E57Header {
  std::uint64_t file_bytes = 0;
  std::uint64_t xml_physical_offset = 0;
  std::uint64_t xml_bytes = 0;  ///< without checksums
};

/// Reads the content of pages, block by block; each page is checked as it is read. Offsets without 'physical' in their name
/// count content only. All functions may throw Error (input_unreadable).
class PagedFile {
 public:
  static constexpr std::size_t PAGE_BYTES = 1024;
  static constexpr std::size_t CONTENT_BYTES = 1020;

  /// Opens a file and reads its header. A page that does not match its checksum is refused by name, unless
  /// `ignore_checksums`.
  PagedFile(const std::filesystem::path& path, bool ignore_checksums);

  [[nodiscard]] const std::filesystem::path& path() const { return in_.path(); }
  [[nodiscard]] const E57Header& header() const { return header_; }
  /// Bytes of content in the file's whole pages.
  [[nodiscard]] std::uint64_t size() const { return page_count_ * CONTENT_BYTES; }
  /// Whether the file has fewer bytes than its header says.
  [[nodiscard]] bool is_cut_off() const { return physical_size_ < header_.file_bytes; }
  [[nodiscard]] std::uint64_t physical_size() const { return physical_size_; }
  /// The first page, from 0, that was read though its checksum is wrong.
  [[nodiscard]] std::optional<std::uint64_t> first_bad_page() const { return first_bad_page_; }

  /// The content's offset of a physical one. Throws where that is a checksum's; `what` stands there by the file's word.
  [[nodiscard]] std::uint64_t content_offset(std::uint64_t physical, const std::string& what) const;

  [[nodiscard]] std::uint64_t offset() const { return offset_; }
  /// Goes to an offset <= size().
  void seek(std::uint64_t offset);
  /// The next `count` <= 65536 bytes, valid until the next call, or nullptr when fewer remain.
  [[nodiscard]] const unsigned char* take(std::size_t count) {
    if (end_ - begin_ < count && !fill(count)) return nullptr;
    const unsigned char* bytes = buffer_.data() + begin_;
    begin_ += count;
    offset_ += count;
    return bytes;
  }

 private:
  void read_header();
  bool fill(std::size_t count);
  void check_page(const unsigned char* page, std::uint64_t number);

  ByteReader in_;
  bool ignore_checksums_;
  std::uint64_t physical_size_;
  std::uint64_t page_count_;
  E57Header header_;
  std::optional<std::uint64_t> first_bad_page_;
  std::vector<unsigned char> buffer_;  ///< content from begin_ to end_
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  std::uint64_t next_page_ = 0;  ///< the first that is not in the buffer
  std::uint64_t offset_ = 0;
};

}  // namespace splatray
