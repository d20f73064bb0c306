/// One scan's file through its reader.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "preprocess/read/formats.h"
#include "tests/readers/read_error.h"

namespace splatray {

struct ReadScan {
  ScanFile file;
  std::vector<std::string> notes;

  [[nodiscard]] bool has_note(const std::string& text) const {
    for (const std::string& note : notes)
      if (note.find(text) != std::string::npos) return true;
    return false;
  }
};

inline ReadScan read_scan(const std::filesystem::path& path, const ScanOptions& scans = {}) {
  ReadOptions options;
  options.scans = scans;
  ReadScan read;
  const ReadListener listener{read.notes, options.progress};
  read.file = find_format(path)->read_scan(path, options, listener);
  return read;
}

/// The sentence that reading with `strict` ends in.
inline std::string strict_error(const std::filesystem::path& path) {
  ReadOptions options;
  options.scans.strict = true;
  return read_error(path, options);
}

}  // namespace splatray
