/// Output files that are whole or absent: written under a temporary name beside the target, renamed when done. What a killed
/// program left of that goes when the next one writes into the folder: a temporary file is locked (flock) while its writer lives. A
/// program that a signal ends (engine/base/interrupt.h) leaves none.
#pragma once
#include <cstdint>
#include <deque>
#include <filesystem>
#include <string>

namespace splatray {

/// What is done where the target is a link.
enum class Links {
  follow,  ///< its target is replaced: for files that the user named
  refuse,  ///< an Error: for files that were not asked for
};

/// One output file in the making. Goes away without a trace unless committed.
class AtomicFile {
 public:
  /// Creates the empty temporary file in the target's folder, under a name that no other writer has; a process's first one there
  /// removes those of dead writers. Throws Error (failed) when the folder does not exist or cannot be written, or when the target
  /// exists and is not a regular file, as a link to no file is not.
  explicit AtomicFile(const std::filesystem::path& target, Links links = Links::follow);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Appends. Throws Error (failed) when not all bytes could be written.
  void write(const void* bytes, std::uint64_t size);
  /// Waits until all is on the disk, then gives the file its name, replacing an older one. Throws Error (failed); an older
  /// file is then as it was.
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path temporary_;  ///< empty once committed
  int descriptor_ = -1;
  std::uint64_t written_ = 0;  ///< bytes
};

/// Files that belong together: all are written before the first of them gets its name.
class FileSet {
 public:
  /// Writes a whole file under its temporary name. Throws Error (failed).
  void add(const std::filesystem::path& target, const void* bytes, std::uint64_t size);
  /// The same of a text.
  void add(const std::filesystem::path& target, const std::string& text);
  /// Gives all their names. Throws Error (failed).
  void commit();

 private:
  std::deque<AtomicFile> files_;
};

/// Throws as AtomicFile's constructor does; for finding out before long work that its result has no place to
/// go.
void require_writable(const std::filesystem::path& target);

/// Writes a whole file, or throws Error (failed) and leaves none.
void write_file(const void* bytes, std::uint64_t size, const std::filesystem::path& target,
                Links links = Links::follow);
/// The same of a text.
void write_text_file(const std::string& text, const std::filesystem::path& target,
                     Links links = Links::follow);

}  // namespace splatray
