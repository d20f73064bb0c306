/// A scene file that is read: bytes at offsets, and the sentence that refuses it.
#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "engine/base/progress.h"
#include "engine/file/file_mapping.h"

namespace splatray::scene_file {

/// Calls `progress`, which may be empty, with done / all. Throws Error (interrupted) where it says so.
void report(const Progress& progress, const char* stage, std::uint64_t done, std::uint64_t all);

inline constexpr std::uint64_t PIECE_BYTES = 1ULL << 24;  ///< read or written between two reports
/// Files and sections of fewer bytes are read, not mapped: no one need keep them as they are then.
inline constexpr std::uint64_t LEAST_MAPPED_BYTES = 1ULL << 20;

class SceneInput {
 public:
  /// Throws as refuse() where there is no file that can be read. `progress` is called with the stage "reading".
  SceneInput(const std::filesystem::path& path, const Progress& progress);
  ~SceneInput();
  SceneInput(const SceneInput&) = delete;
  SceneInput& operator=(const SceneInput&) = delete;

  [[nodiscard]] std::uint64_t size() const { return size_; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// The file where it is mapped; null where it is to be read, as small ones are.
  [[nodiscard]] const std::shared_ptr<const FileMapping>& mapping() const { return mapping_; }

  /// Throws as refuse() where the file ends before, Error (interrupted) where progress says so.
  void read(std::uint64_t offset, void* target, std::uint64_t bytes);
  /// XXH3-64 of bytes that are not read for anything else. Throws as read().
  [[nodiscard]] std::uint64_t checksum(std::uint64_t offset, std::uint64_t bytes);

  /// Throws Error (input_unreadable), a sentence with the path.
  [[noreturn]] void refuse(const std::string& found, const std::string& expected) const;

 private:
  /// So many bytes more were read.
  void count(std::uint64_t bytes);

  std::filesystem::path path_;
  const Progress& progress_;
  int descriptor_ = -1;
  std::shared_ptr<const FileMapping> mapping_;
  std::uint64_t size_ = 0;
  std::uint64_t done_ = 0;  ///< bytes read so far
};

}  // namespace splatray::scene_file
