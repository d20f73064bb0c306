/// Reads a file front to back in blocks, so that a reader's memory does not depend on the file's size.
#pragma once
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "preprocess/read/read_listener.h"

namespace splatray {

/// Throws Error (input_unreadable): "<path>: <what>".
[[noreturn]] void throw_unreadable(const std::filesystem::path& path, const std::string& what);

class ByteReader {
 public:
  /// Most bytes one take() may ask for.
  static constexpr std::size_t BLOCK_BYTES = std::size_t{1} << 20U;

  /// Opens a regular file that is not empty; throws Error (input_unreadable) otherwise. `listener` hears of each block; it
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

  /// Skips bytes; false when fewer remain.
  [[nodiscard]] bool skip(std::uint64_t count);

  /// The next line without its end (LF or CR LF), valid until the next call; false at the end of the file.
  /// The last line may lack its end. A line is never longer than `max_bytes`: a longer one is cut there.
  [[nodiscard]] bool line(std::string_view& text, std::size_t max_bytes);

 private:
  bool fill(std::size_t count);

  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::filesystem::path path_;
  const ReadListener* listener_;
  std::unique_ptr<std::FILE, Close> file_;
  std::vector<unsigned char> buffer_;
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  std::uint64_t offset_ = 0;
  std::uint64_t size_ = 0;
};

}  // namespace splatray
