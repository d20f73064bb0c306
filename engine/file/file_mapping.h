/// A file that is read where the kernel keeps it, in memory that it may take back.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

namespace splatray {

/// The bytes of a file, mapped. They may be read from any thread, also where someone else makes the file shorter or its disk fails: what is
/// gone reads as zeros then, require_whole says so, and what was made of them is worth nothing. While there is a mapping, SIGBUS has a
/// handler, which leaves signals of all other places to the one before it.
class FileMapping {
 public:
  /// Maps an open file, which may be closed then. Null where it cannot be mapped, or too many are: it is to be read then.
  [[nodiscard]] static std::shared_ptr<const FileMapping> map(int descriptor,
                                                              const std::filesystem::path& path);
  ~FileMapping();
  FileMapping(const FileMapping&) = delete;
  FileMapping& operator=(const FileMapping&) = delete;

  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }

  /// Throws Error (input_unreadable), a sentence with the path, where the file has changed since it was mapped. From any thread.
  void require_whole() const;

 private:
  FileMapping() = default;
  [[nodiscard]] bool is_whole() const;

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::int64_t changed_s_ = 0, changed_ns_ = 0;  ///< when the file was, as it was mapped
  std::span<const std::byte> bytes_;
  std::size_t place_ = 0;  ///< among those that the handler knows
};

/// require_whole of all mappings that there are: before a file is written, which may be made of any.
void require_whole_mappings();

}  // namespace splatray
