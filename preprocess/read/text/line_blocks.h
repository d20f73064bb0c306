/// A text file in blocks of whole lines.
#pragma once
#include <filesystem>
#include <span>
#include <vector>

#include "preprocess/read/bytes/byte_reader.h"

namespace splatray {

/// A place between two lines of a file.
struct TextPlace {
  std::uint64_t offset = 0;  ///< in bytes
  std::uint64_t lines = 0;   ///< before it
};

class LineBlocks {
 public:
  static constexpr std::size_t BLOCK_BYTES = std::size_t{4} << 20U;

  /// Opens the file as ByteReader does and goes to `start`, behind a byte order mark as ByteReader::begin_text() does.
  LineBlocks(const std::filesystem::path& path, const ReadListener& listener, const TextPlace& start);

  /// The next lines, all with their ends but for the file's last; empty at the end. All lines end in LF: a CR without one
  /// has become one, and one before it is left as a blank. The bytes may be written to, and are
  /// valid until the next call. Throws Error (input_unreadable) for a line longer than BLOCK_BYTES.
  [[nodiscard]] std::span<char> next();

  [[nodiscard]] const std::filesystem::path& path() const { return in_.path(); }

 private:
  void read_more();

  ByteReader in_;
  std::vector<char> buffer_;
  std::size_t used_ = 0;  ///< bytes of the buffer that the last call gave
};

}  // namespace splatray
