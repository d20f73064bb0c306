/// Output files that are whole or absent: written under a temporary name beside the target, renamed when
/// done.
#pragma once
#include <filesystem>
#include <string>

namespace splatray {

/// One output file in the making. Goes away without a trace unless committed.
class AtomicFile {
 public:
  /// Creates the empty temporary file in the target's folder. Throws Error (failed) when the folder does not
  /// exist or cannot be written, or when the target exists and is not a regular file.
  explicit AtomicFile(const std::filesystem::path& target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Where to write. The file exists and is empty.
  [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }
  /// Gives the file its name, replacing an older one. Throws Error (failed).
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path temporary_;  ///< empty once committed
};

/// Throws as AtomicFile's constructor does; for finding out before long work that its result has no place to
/// go.
void require_writable(const std::filesystem::path& target);

/// Writes a whole text file, or throws Error (failed) and leaves none.
void write_text_file(const std::string& text, const std::filesystem::path& target);

}  // namespace splatray
