#include "preprocess/read/e57/paged_file.h"

#include <algorithm>
#include <cstring>

#include "preprocess/read/e57/crc32c.h"

namespace splatray {
namespace {

constexpr std::size_t E57_HEADER_BYTES = 48;
constexpr char SIGNATURE[] = "ASTM-E57";
constexpr std::uint64_t BLOCK_PAGES = 64;
constexpr std::size_t MOST_TAKEN = 65536;

template <typename T>
T word_at(const unsigned char* bytes, std::size_t offset) {
  T word{};
  std::memcpy(&word, bytes + offset, sizeof word);
  return word;
}

std::uint32_t stored_checksum(const unsigned char* page) {
  const unsigned char* bytes = page + PagedFile::CONTENT_BYTES;  // the most significant first
  return std::uint32_t{bytes[0]} << 24U | std::uint32_t{bytes[1]} << 16U | std::uint32_t{bytes[2]} << 8U |
         bytes[3];
}

}  // namespace

PagedFile::PagedFile(const std::filesystem::path& path, bool ignore_checksums)
    : in_(path),
      ignore_checksums_(ignore_checksums),
      physical_size_(in_.remaining()),
      page_count_(physical_size_ / PAGE_BYTES),
      buffer_(BLOCK_PAGES * CONTENT_BYTES + MOST_TAKEN) {
  read_header();
  in_.seek(0);
}

void PagedFile::read_header() {
  const unsigned char* bytes = in_.take(E57_HEADER_BYTES);
  if (bytes == nullptr || std::memcmp(bytes, SIGNATURE, sizeof SIGNATURE - 1) != 0)
    throw_unreadable(path(), "found no signature ASTM-E57 at its begin, expected an E57 file");
  const auto major = word_at<std::uint32_t>(bytes, 8);
  const auto page_bytes = word_at<std::uint64_t>(bytes, 40);
  if (major != 1)
    throw_unreadable(path(), "found E57 of version " + std::to_string(major) + ", expected version 1");
  if (page_bytes != PAGE_BYTES)
    throw_unreadable(path(), "found pages of " + std::to_string(page_bytes) + " bytes, expected 1024");
  if (page_count_ == 0)
    throw_unreadable(path(), "found " + std::to_string(physical_size_) +
                                 " bytes, expected at least one page of 1024 bytes");
  header_.file_bytes = word_at<std::uint64_t>(bytes, 16);
  header_.xml_physical_offset = word_at<std::uint64_t>(bytes, 24);
  header_.xml_bytes = word_at<std::uint64_t>(bytes, 32);
  in_.seek(0);
  const unsigned char* page = in_.take(PAGE_BYTES);
  if (page == nullptr) throw_unreadable(path(), "its first page cannot be read");
  check_page(page, 0);  // before an offset is believed
}

std::uint64_t PagedFile::content_offset(std::uint64_t physical, const std::string& what) const {
  if (physical % PAGE_BYTES >= CONTENT_BYTES)
    throw_unreadable(
        path(), "found " + what + " at byte " + std::to_string(physical) + ", where a page's checksum is");
  return physical / PAGE_BYTES * CONTENT_BYTES + physical % PAGE_BYTES;
}

void PagedFile::seek(std::uint64_t offset) {
  const std::uint64_t buffered = offset_ - begin_;
  if (offset >= buffered && offset - buffered <= end_) {
    begin_ = static_cast<std::size_t>(offset - buffered);
    offset_ = offset;
    return;
  }
  next_page_ = std::min(offset / CONTENT_BYTES, page_count_);
  in_.seek(next_page_ * PAGE_BYTES);
  begin_ = end_ = 0;
  offset_ = next_page_ * CONTENT_BYTES;
  static_cast<void>(take(static_cast<std::size_t>(offset - offset_)));
}

bool PagedFile::fill(std::size_t count) {
  if (count > size() - offset_) return false;
  std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
  while (end_ < count) {
    const std::uint64_t pages = std::min(BLOCK_PAGES, page_count_ - next_page_);
    const unsigned char* page = in_.take(static_cast<std::size_t>(pages) * PAGE_BYTES);
    if (page == nullptr) throw_unreadable(path(), "its end cannot be read");
    for (const std::uint64_t last = next_page_ + pages; next_page_ < last; ++next_page_, page += PAGE_BYTES) {
      check_page(page, next_page_);
      std::memcpy(buffer_.data() + end_, page, CONTENT_BYTES);
      end_ += CONTENT_BYTES;
    }
  }
  return true;
}

void PagedFile::check_page(const unsigned char* page, std::uint64_t number) {
  if (crc32c(page, CONTENT_BYTES) == stored_checksum(page)) return;
  if (!ignore_checksums_)
    throw_unreadable(path(), "page " + std::to_string(number) + " (from byte " +
                                 std::to_string(number * PAGE_BYTES) +
                                 ") does not match its checksum: the file is damaged; "
                                 "--ignore-checksums reads it as it is");
  first_bad_page_ = std::min(number, first_bad_page_.value_or(number));
}

}  // namespace splatray
