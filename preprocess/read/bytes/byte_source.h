/// Where readers' bytes come from: a file, or a server that gives parts of one.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>

namespace splatray {

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
};

/// Opens a regular file that is not empty, or what a URL names, by the module that has libcurl. Throws Error (input_unreadable), one
/// sentence.
[[nodiscard]] std::unique_ptr<ByteSource> open_source(const std::filesystem::path& path);

}  // namespace splatray
