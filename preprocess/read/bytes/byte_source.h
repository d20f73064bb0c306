/// Where readers' bytes come from: a file, or a server that gives parts of one.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

namespace splatray {

/// Some bytes of a file, and where they go.
struct BytePart {
  std::uint64_t offset = 0;
  unsigned char* to = nullptr;
  std::size_t count = 0;
};

class ByteSource {
 public:
  ByteSource() = default;
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;
  virtual ~ByteSource() = default;

  /// Bytes of the whole.
  [[nodiscard]] virtual std::uint64_t size() const = 0;
  /// Whether reading more than is needed costs little.
  [[nodiscard]] virtual bool is_near() const = 0;
  /// Reads `count` bytes from `offset` on to `to`, fewer where the whole ends before; returns how many. Throws Error
  /// (input_unreadable), one sentence, for what can no longer be read.
  [[nodiscard]] virtual std::size_t read(std::uint64_t offset, unsigned char* to, std::size_t count) = 0;
  /// Reads parts, all of which lie in the whole; a server's, some at a time. Returns false where one could not be read to its end.
  /// Throws Error as read does.
  [[nodiscard]] virtual bool read_parts(std::span<const BytePart> parts) {
    for (const BytePart& part : parts)
      if (read(part.offset, part.to, part.count) < part.count) return false;
    return true;
  }
};

/// Opens a regular file that is not empty, or what a URL names, by the module that has libcurl. Throws Error (input_unreadable), one
/// sentence.
[[nodiscard]] std::unique_ptr<ByteSource> open_source(const std::filesystem::path& path);

}  // namespace splatray
