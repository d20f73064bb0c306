/// Reads a file, or what a URL names, front to back in blocks, so that a reader's memory does not depend on the file's size.
#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "preprocess/read/bytes/byte_source.h"
#include "preprocess/read/read_listener.h"

namespace splatray {

/// The byte order mark that some programs write before a text of UTF-8.
inline constexpr std::string_view UTF8_MARK = "\xEF\xBB\xBF";

/// Throws Error (input_unreadable): "<path>: <what>".
[[noreturn]] void throw_unreadable(const std::filesystem::path& path, const std::string& what);

class ByteReader {
 public:
  /// Most bytes one take() may ask for.
  static constexpr std::size_t BLOCK_BYTES = std::size_t{1} << 20U;

  /// Opens a regular file, or what a URL names, that is neither empty nor an archive; throws Error (input_unreadable) otherwise. `listener` hears of each block; it
  /// must live as long as this. All functions that read may so throw Error (interrupted).
  explicit ByteReader(const std::filesystem::path& path, const ReadListener* listener = nullptr);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Bytes consumed so far.
  [[nodiscard]] std::uint64_t offset() const { return offset_; }
  /// Bytes not yet consumed.
  [[nodiscard]] std::uint64_t remaining() const { return size_ - offset_; }

  /// The next `count` <= BLOCK_BYTES bytes, valid until the next call, or nullptr when fewer remain.
  [[nodiscard]] const unsigned char* take(std::size_t count) {
    if (end_ - begin_ < count && !fill(count)) {
      return nullptr;
    }
    const unsigned char* bytes = buffer_.data() + begin_;
    begin_ += count;
    offset_ += count;
    return bytes;
  }

  /// Goes to an offset from the file's begin, at most its size.
  void seek(std::uint64_t offset);

  /// The next `count` bytes, or those that remain where these are fewer.
  [[nodiscard]] std::vector<unsigned char> read(std::uint64_t count);

  /// The bytes of parts of the file, one behind the other; offset and count of each. What is read next is where it was.
  struct Range {
    std::uint64_t offset, count;
  };
  [[nodiscard]] std::vector<unsigned char> read(std::span<const Range> ranges);

  /// Skips bytes; false when fewer remain.
  [[nodiscard]] bool skip(std::uint64_t count);

  /// Goes behind a byte order mark where the file begins with one; does nothing elsewhere than at the file's begin. Throws
  /// Error (input_unreadable) for text in UTF-16, which has a mark of its own or zeros beside its letters.
  void begin_text();

  /// The next line without its end (LF, CR LF or CR), valid until the next call; false at the end of the file.
  /// The last line may lack its end. A line is never longer than `max_bytes`: a longer one is cut there. The file's
  /// first line begins as begin_text() has it.
  [[nodiscard]] bool line(std::string_view& text, std::size_t max_bytes);

  /// Whether the last line() had no end: the file ends in it, or it was cut.
  [[nodiscard]] bool line_is_open() const { return line_is_open_; }

 private:
  bool fill(std::size_t count);
  std::size_t end_of_line(std::size_t length, std::size_t max_bytes);

  std::filesystem::path path_;
  const ReadListener* listener_;
  std::unique_ptr<ByteSource> source_;
  std::vector<unsigned char> buffer_;
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  std::uint64_t offset_ = 0;
  std::uint64_t size_ = 0;
  /// A CR without LF ended one: an LF behind a CR belongs to what follows, as a binary body.
  bool cr_ends_lines_ = false;
  bool line_is_open_ = false;
};

}  // namespace splatray
